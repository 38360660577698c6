// SPDX-License-Identifier: MIT
// 'kaustik experiment run': every run once, whatever happens in between.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <map>
#include <thread>

#include "tests/cli/experiment_fixture.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ExperimentRun = ExperimentCommand;
using Resume = ExperimentCommand;

TEST_F(ExperimentRun, DoesEveryCombinationAndRepeatAndNamesThemByTheirSettings) {
    const Outcome outcome = run(study());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("4 runs done, 0 there already"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("wrote out/runs.csv\n"), std::string::npos) << outcome.out;
    const std::vector<std::string> names = runs();
    ASSERT_EQ(names.size(), 4u);
    EXPECT_EQ(names[0].size(), 32u);
    EXPECT_EQ(names[1], names[0] + "-r2");
    EXPECT_EQ(names[3], names[2] + "-r2");
    for (const std::string& file : files())
        EXPECT_EQ(file.find("/."), std::string::npos) << file << " is a temporary file";
}

TEST_F(ExperimentRun, DoesThoseRunsAloneThatAreAskedForAndKeepsTheRowsOfTheOthers) {
    const Outcome first = run(study({"--only", "layers.count=2"}));
    ASSERT_EQ(first.exitCode, 0) << first.err;
    EXPECT_NE(first.out.find("2 runs done, 0 there already"), std::string::npos) << first.out;
    EXPECT_EQ(column("layers.count"), (std::vector<std::string>{"2", "2"}));
    const std::vector<std::string> before = column("frame_ms.median");

    // The rest into the same table; what was there is not done again, with --resume or without.
    const Outcome second = run(study({"--only", "count=1", "--resume"}));
    ASSERT_EQ(second.exitCode, 0) << second.err;
    EXPECT_NE(second.out.find("2 runs done, 0 there already"), std::string::npos) << second.out;
    EXPECT_EQ(column("layers.count"), (std::vector<std::string>{"1", "1", "2", "2"}));
    const std::vector<std::string> after = column("frame_ms.median");
    ASSERT_EQ(after.size(), 4u);
    EXPECT_EQ((std::vector<std::string>{after[2], after[3]}), before);

    const Outcome all = run(study({"--resume"}));
    EXPECT_NE(all.out.find("0 runs done, 4 there already"), std::string::npos) << all.out;
}

TEST_F(ExperimentRun, RefusesRunsThatTheStudyDoesNotHaveBeforeAnythingIsDone) {
    for (const auto& [condition, says] :
         std::map<std::string, std::string>{{"layers.cuont=1", "did you mean 'layers.count'?"},
                                            {"layers.count=3", "There is 1 and 2."},
                                            {"layers.count", "is not KEY=VALUE"}}) {
        const Outcome outcome = run(study({"--only", condition}));
        EXPECT_EQ(outcome.exitCode, 2) << condition;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
        EXPECT_TRUE(runs().empty()) << condition;
    }
    const Outcome report = run({"experiment", "report", "out", "--only", "layers.count=1"});
    EXPECT_EQ(report.exitCode, 2);
}

TEST_F(ExperimentRun, WritesOneRowARunWithSettingsTimesPassesAndEnergy) {
    ASSERT_EQ(run(study()).exitCode, 0);
    EXPECT_EQ(column("layers.count"), (std::vector<std::string>{"1", "1", "2", "2"}));
    EXPECT_EQ(column("repeat"), (std::vector<std::string>{"1", "2", "1", "2"}));
    EXPECT_EQ(column("status"), std::vector<std::string>(4, "done"));
    for (const char* name : {"frame_ms.median", "frame_ms.stdev", "pass:layers.peel",
                             "energy.balance", "scene.triangles", "map.count", "energy.emitted_w",
                             "photons.emitted", "memory.peak_bytes", "startup_ms"}) {
        const std::vector<std::string> cells = column(name);
        ASSERT_EQ(cells.size(), 4u) << name;
        for (const std::string& cell : cells)
            EXPECT_NO_THROW(static_cast<void>(std::stod(cell))) << name << ": '" << cell << "'";
    }
}

TEST_F(ExperimentRun, KeepsEverySampleOfEveryFrame) {
    writeStudy("[permute]\nframes = [3]\n");  // the base says 1
    ASSERT_EQ(run(study()).exitCode, 0);
    const json samples = json::parse(contents("out/samples.json"));
    EXPECT_EQ(samples.at("schema"), "kaustik.experiment-samples/1");
    ASSERT_EQ(samples.at("runs").size(), 2u);
    for (const json& run : samples.at("runs")) {
        EXPECT_EQ(run.at("frame_samples_ms").size(), 3u);
        ASSERT_FALSE(run.at("passes").empty());
        for (const json& pass : run.at("passes"))
            EXPECT_EQ(pass.at("gpu_ms").size(), 3u) << pass;
    }
}

TEST_F(ExperimentRun, ResolvesAllSettingsIntoTheRecordOfARun) {
    ASSERT_EQ(run(study()).exitCode, 0);
    const std::string first = runs()[0];
    const json record = json::parse(contents("out/" + first + "/run.json"));
    EXPECT_EQ(record.at("hash"), first);
    const json report = json::parse(contents("out/" + first + "/report.json"));
    EXPECT_EQ(record.at("settings").at("parameters"), report.at("parameters"));
    EXPECT_EQ(record.at("settings").at("scene").at("name"), "wavy.toml");
    EXPECT_TRUE(report.at("warnings").empty()) << report.at("warnings");
}

TEST_F(ExperimentRun, InterleavesTheRepeats) {
    ASSERT_EQ(run(study()).exitCode, 0);
    std::map<fs::file_time_type, int> repeatAt;
    for (const std::string& name : runs()) {
        repeatAt[fs::last_write_time(folder / ("out/" + name + "/run.json"))] =
            name.ends_with("-r2") ? 2 : 1;
    }
    std::vector<int> repeats;
    for (const auto& [time, repeat] : repeatAt)
        repeats.push_back(repeat);
    EXPECT_EQ(repeats, (std::vector<int>{1, 1, 2, 2}));
}

TEST_F(ExperimentRun, WritesIntoAFolderOfItsNameByDefault) {
    ASSERT_EQ(run({"experiment", "run", "study.toml"}).exitCode, 0);
    EXPECT_TRUE(files().contains("results/runs/experiments/layers/runs.csv"));
}

TEST_F(ExperimentRun, RecordsARunThatFailsAndGoesOn) {
    // No device holds 64 layers of that size.
    writeStudy("[permute]\nsize = ['16384x16384', '32x24']\n'layers.count' = [64]\n");
    const Outcome outcome = run(study());
    expectFailure(outcome, 1, {"2 of 4 runs failed", "fewer photons", "out/runs.csv"});
    EXPECT_EQ(column("status"), (std::vector<std::string>{"failed", "failed", "done", "done"}));
    const std::vector<std::string> times = column("frame_ms.median");
    EXPECT_TRUE(times[0].empty() && times[1].empty());
    EXPECT_FALSE(times[2].empty() || times[3].empty());
    EXPECT_EQ(runs().size(), 2u);
    const std::string hash = column("hash")[0];
    const json failure = json::parse(contents("out/" + hash + ".failed.json"));
    EXPECT_NE(failure.at("message").get<std::string>().find("fewer photons"), std::string::npos);
}

TEST_F(ExperimentRun, GoesOnWhenItsProgramIsGone) {
    // As when it is built anew: a build tree of its own, with what the program needs there.
    const fs::path built = fs::path(KAUSTIK_BINARY).parent_path();
    const fs::path bin = folder / "tree/bin";
    fs::create_directories(bin);
    fs::copy_file(built.parent_path() / "kaustik_source_tree", folder / "tree/kaustik_source_tree");
    for (const fs::directory_entry& entry : fs::directory_iterator(built)) {
        if (entry.path().filename().string().starts_with("kaustik"))
            fs::copy_file(entry.path(), bin / entry.path().filename());
    }
    Conditions conditions;
    conditions.folder = folder / ".";
    conditions.program = bin / "kaustik";
    Program program(study(), conditions);
    while (runs().empty() && program.isRunning())
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    fs::remove(bin / "kaustik");
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(runs().size(), 4u);
}

TEST_F(ExperimentRun, InAFolderThatAnotherProcessWritesIntoIsRefused) {
    fs::create_directory(folder / "out");
    const int other = ::open((folder / "out").c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(::flock(other, LOCK_EX), 0);
    expectFailure(run(study()), 2, {"--out", "out", "another experiment"});
    ::close(other);
    EXPECT_EQ(run(study()).exitCode, 0);
}

TEST_F(ExperimentRun, OnADiskThatFillsUpIsAMessageAndNoHalfRun) {
    Conditions limited;
    limited.largestFileBytes = 2048;  // less than experiment.json and the pictures
    const Outcome outcome = run(study(), limited);
    expectFailure(outcome, 1, {"cannot be written"});
    EXPECT_TRUE(runs().empty());
    for (const std::string& file : files())
        EXPECT_EQ(file.find(".part"), std::string::npos) << file;
}

TEST_F(Resume, LeavesFinishedRunsAlone) {
    ASSERT_EQ(run(study()).exitCode, 0);
    std::map<std::string, std::string> before;
    for (const std::string& name : runs())
        before[name] = contents("out/" + name + "/report.json");
    const std::string table = contents("out/runs.csv");
    const std::string samples = contents("out/samples.json");
    const Outcome again = run(study({"--resume"}));
    ASSERT_EQ(again.exitCode, 0) << again.err;
    EXPECT_NE(again.out.find("0 runs done, 4 there already"), std::string::npos) << again.out;
    for (const auto& [name, report] : before)
        EXPECT_EQ(contents("out/" + name + "/report.json"), report);
    EXPECT_EQ(contents("out/runs.csv"), table);
    EXPECT_EQ(contents("out/samples.json"), samples);
}

TEST_F(Resume, WithMoreRepeatsAndValuesDoesOnlyWhatIsNew) {
    writeStudy("[permute]\n'layers.count' = [2]\n");
    ASSERT_EQ(run(study()).exitCode, 0);
    writeStudy("[permute]\n'layers.count' = [1, 2]\n");
    const Outcome more = run(study({"--resume"}));
    ASSERT_EQ(more.exitCode, 0) << more.err;
    EXPECT_NE(more.out.find("2 runs done, 2 there already"), std::string::npos) << more.out;
}

TEST_F(Resume, WithoutTheOptionEveryRunIsDoneAgain) {
    ASSERT_EQ(run(study()).exitCode, 0);
    const Outcome again = run(study());
    ASSERT_EQ(again.exitCode, 0) << again.err;
    EXPECT_NE(again.out.find("4 runs done, 0 there already"), std::string::npos) << again.out;
    EXPECT_EQ(runs().size(), 4u);
}

TEST_F(Resume, DoesDamagedRunsAgain) {
    ASSERT_EQ(run(study({}, "whole")).exitCode, 0);
    ASSERT_EQ(run(study()).exitCode, 0);
    const std::vector<std::string> names = runs();
    // A file cut off, a bit that has turned, a file that is gone, and no record.
    fs::resize_file(folder / ("out/" + names[0] + "/caustic.exr"), 100);
    {
        std::fstream picture(folder / ("out/" + names[1] + "/beauty.exr"),
                             std::ios::in | std::ios::out | std::ios::binary);
        picture.seekg(200);
        const char byte = static_cast<char>(picture.get() ^ 1);
        picture.seekp(200);
        picture.put(byte);
    }
    fs::remove(folder / ("out/" + names[2] + "/report.json"));
    fs::remove(folder / ("out/" + names[3] + "/run.json"));
    const Outcome resumed = run(study({"--resume"}));
    ASSERT_EQ(resumed.exitCode, 0) << resumed.err;
    EXPECT_NE(resumed.out.find("4 runs done, 0 there already, 4 of those done were damaged"),
              std::string::npos)
        << resumed.out;
    expectSameResults("whole", "out");
}

class Stopped : public ExperimentCommand, public testing::WithParamInterface<int> {
  protected:
    // Stops a study once its first run is there.
    [[nodiscard]] Outcome stopInTheMiddle() const {
        Conditions here;
        here.folder = folder / ".";
        Program program(study(), here);
        while (runs().empty())
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        program.send(GetParam());
        return program.wait();
    }
};

TEST_P(Stopped, LosesNothingThatIsDoneAndResumes) {
    ASSERT_EQ(run(study({}, "whole")).exitCode, 0);
    const Outcome stopped = stopInTheMiddle();
    if (GetParam() == SIGKILL) {
        EXPECT_EQ(stopped.exitCode, -SIGKILL);
    } else {
        expectFailure(stopped, 1, {"Interrupted", "of 4 runs are finished", "--resume"});
        for (const std::string& file : files())
            EXPECT_EQ(file.find(".part"), std::string::npos) << file;
        EXPECT_FALSE(table().empty());
    }
    const std::vector<std::string> done = runs();
    ASSERT_LT(done.size(), 4u) << "the study ended before it was stopped";
    std::map<std::string, std::string> before;
    for (const std::string& name : done)
        before[name] = contents("out/" + name + "/report.json");
    const Outcome resumed = run(study({"--resume"}));
    ASSERT_EQ(resumed.exitCode, 0) << resumed.err;
    EXPECT_NE(resumed.out.find(
                  fmt::format("{} runs done, {} there already", 4 - done.size(), done.size())),
              std::string::npos)
        << resumed.out;
    for (const auto& [name, report] : before)
        EXPECT_EQ(contents("out/" + name + "/report.json"), report) << "it was done again";
    expectSameResults("whole", "out");
    for (const std::string& file : files())
        EXPECT_EQ(file.find(".part"), std::string::npos) << file;
}

std::string signalName(const testing::TestParamInfo<int>& signal) {
    if (signal.param == SIGKILL) return "Killed";
    return signal.param == SIGINT ? "Interrupted" : "Terminated";
}

INSTANTIATE_TEST_SUITE_P(Every, Stopped, testing::Values(SIGINT, SIGTERM, SIGKILL), signalName);

}  // namespace
}  // namespace kaustik::test
