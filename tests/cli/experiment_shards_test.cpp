// SPDX-License-Identifier: MIT
// 'kaustik experiment run --shard' and 'experiment merge': a study that several machines do.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

#include "tests/cli/experiment_fixture.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class ExperimentShards : public ExperimentCommand {
  protected:
    [[nodiscard]] Outcome shard(const std::string& number, const std::string& out = "out") const {
        return run(study({"--shard", number, "--resume"}, out));
    }
    void doShard(const std::string& number, const std::string& out = "out") const {
        const Outcome outcome = shard(number, out);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    }
    [[nodiscard]] Outcome merge(const std::vector<std::string>& folders,
                                const std::vector<std::string>& more = {"--out", "merged"}) const {
        std::vector<std::string> arguments = {"experiment", "merge"};
        arguments.insert(arguments.end(), folders.begin(), folders.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
};

TEST_F(ExperimentShards, InOneFolderAtTheSameTimeAreTheWholeStudy) {
    ASSERT_EQ(run(study({}, "whole")).exitCode, 0);
    Conditions here;
    here.folder = folder / ".";
    {
        // One of them twice, as when a task is requeued that was not dead.
        std::vector<std::unique_ptr<Program>> all;
        for (const char* number : {"1/2", "2/2", "2/2"}) {
            all.push_back(std::make_unique<Program>(study({"--shard", number, "--resume"}), here));
        }
        for (const auto& program : all) {
            const Outcome outcome = program->wait();
            EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
            EXPECT_NE(outcome.out.find("experiment merge out"), std::string::npos) << outcome.out;
        }
    }
    EXPECT_FALSE(files().contains("out/runs.csv"));
    expectFailure(run({"experiment", "report", "out"}), 2, {"not merged", "merge out"});
    const Outcome merged = merge({"out"}, {});
    ASSERT_EQ(merged.exitCode, 0) << merged.err;
    EXPECT_NE(merged.out.find("4 of 4 runs"), std::string::npos) << merged.out;
    expectSameResults("whole", "out");
    EXPECT_EQ(contents("whole/experiment.json"), contents("out/experiment.json"));
    for (const std::string& file : files())
        EXPECT_EQ(file.find("/."), std::string::npos) << file << " is a temporary file";
    // Again, and into a folder of its own.
    const std::string table = contents("out/runs.csv");
    ASSERT_EQ(merge({"out"}, {}).exitCode, 0);
    EXPECT_EQ(contents("out/runs.csv"), table);
    ASSERT_EQ(merge({"out"}).exitCode, 0);
    EXPECT_EQ(contents("merged/runs.csv"), table);
}

TEST_F(ExperimentShards, OfFoldersOfTheirOwnMergeInAnyOrderWithThoseThatRanTwice) {
    doShard("1/2", "a");
    doShard("2/2", "b");
    doShard("2/2", "c");  // the same runs, a little later
    EXPECT_EQ(runs("a").size() + runs("b").size(), 4u);
    EXPECT_EQ(runs("b"), runs("c"));
    ASSERT_EQ(merge({"c", "a", "b"}, {"--out", "one"}).exitCode, 0);
    ASSERT_EQ(merge({"b", "c", "a"}, {"--out", "other"}).exitCode, 0);
    EXPECT_EQ(contents("one/runs.csv"), contents("other/runs.csv"));
    EXPECT_EQ(contents("one/samples.json"), contents("other/samples.json"));
    for (const std::string& name : runs("b"))
        EXPECT_EQ(contents("one/" + name + "/report.json"), contents("b/" + name + "/report.json"))
            << "the first that was finished counts";
    // Step by step into one folder: what is there counts too.
    expectFailure(merge({"a"}, {"--out", "steps"}), 2, {"missing"});
    ASSERT_EQ(merge({"a"}, {"--out", "steps", "--incomplete"}).exitCode, 0);
    ASSERT_EQ(merge({"b"}, {"--out", "steps"}).exitCode, 0);
    EXPECT_EQ(contents("steps/runs.csv"), contents("one/runs.csv"));
}

TEST_F(ExperimentShards, ThatAreMissingOrDamagedAreNamedAndNothingIsWritten) {
    doShard("1/2", "a");
    ASSERT_FALSE(runs("a").empty());
    expectFailure(merge({"a"}), 2,
                  {"2 of 4 runs are missing", "layers.count = ", "repeat 1", "--incomplete"});
    doShard("2/2", "a");
    fs::resize_file(folder / ("a/" + runs("a")[1] + "/report.json"), 10);
    expectFailure(merge({"a"}), 2, {"1 of 4 runs are missing", "report.json", "damaged"});
    EXPECT_FALSE(fs::exists(folder / "merged"));
    doShard("1/2", "a");
    doShard("2/2", "a");
    EXPECT_EQ(merge({"a"}).exitCode, 0);
}

TEST_F(ExperimentShards, OfADescriptionThatSomebodyMadeUpAreAnError) {
    doShard("1/1", "a");
    const auto withDescription = [&](const std::string& text) {
        static_cast<void>(folder.file("a/experiment.json", text));
        return merge({"a"});
    };
    json made = json::parse(contents("a/experiment.json"));
    made["repeats"] = 2.6e23;
    expectFailure(withDescription(made.dump()), 1, {"experiment.json", "2.6e+23"});
    made["repeats"] = 2;
    made["runs"][0]["hash"] = "../../elsewhere";
    expectFailure(withDescription(made.dump()), 1, {"experiment.json", "no fingerprint of a run"});
    const std::string nested = std::string(100000, '[') + std::string(100000, ']');
    expectFailure(withDescription(nested), 1, {"experiment.json", "nested more than"});
    EXPECT_FALSE(fs::exists(folder / "merged"));
}

TEST_F(ExperimentShards, ThatFailedInOnePlaceAndAreDoneInAnotherAreDone) {
    writeStudy("[permute]\nsize = ['16384x16384', '32x24']\n'layers.count' = [64]\n");
    const Outcome first = shard("1/1", "a");
    expectFailure(first, 1, {"2 of 4 runs failed", "fewer photons", "a have them all"});
    const Outcome merged = merge({"a"});
    expectFailure(merged, 1, {"2 of 4 runs failed", "merged/runs.csv"});
    EXPECT_EQ(column("status", "merged"),
              (std::vector<std::string>{"failed", "failed", "done", "done"}));
    // The record of a failure next to the run itself, as two tasks may leave them.
    const std::string done = runs("a")[0];
    fs::create_directory(folder / "b");
    fs::copy_file(folder / "a/experiment.json", folder / "b/experiment.json");
    json failure = {{"schema", "kaustik.failure/1"}, {"message", "no device."}};
    static_cast<void>(folder.file("b/" + done + ".failed.json", failure.dump()));
    expectFailure(merge({"b", "a"}, {"--out", "again"}), 1, {"2 of 4 runs failed"});
    EXPECT_EQ(column("status", "again"), column("status", "merged"));
}

TEST_F(ExperimentShards, OfDifferentStudiesAreRefused) {
    doShard("1/2", "a");
    doShard("2/2", "b");
    json described = json::parse(contents("b/experiment.json"));
    const auto expectRefusal = [&](const json& other, const std::string& reason) {
        static_cast<void>(folder.file("b/experiment.json", other.dump()));
        expectFailure(merge({"a", "b"}), 2, {"a and b", "not of one study", reason});
    };
    json other = described;
    other["version"] = "0.0.9";
    expectRefusal(other, "version \"0.0.9\" instead of");
    other = described;
    other["name"] = "another";
    expectRefusal(other, "name \"another\" instead of \"layers\"");
    other = described;
    other["repeats"] = 3;
    expectRefusal(other, "repeats 3 instead of 2");
    static_cast<void>(folder.file("b/experiment.json", "{"));
    expectFailure(merge({"a", "b"}), 1, {"b/experiment.json"});

    // The same study of a scene that has changed.
    std::string scene = kWavyWater;
    scene.replace(scene.find("1.333"), 5, "1.332");
    static_cast<void>(folder.file("wavy.toml", scene));
    doShard("2/2", "c");
    expectFailure(merge({"a", "c"}), 2, {"a and c", "other contents of a scene"});
    expectFailure(shard("2/2", "a"), 2, {"--out", "a holds results of another study"});
    EXPECT_FALSE(fs::exists(folder / "merged"));
}

TEST_F(ExperimentShards, ThatMakeNoSenseAreRefused) {
    for (const char* number : {"5/4", "0/4", "x/y", "2"})
        expectFailure(shard(number), 2, {"--shard"});
    static_cast<void>(folder.file("suite.toml", "name = 'n'\nsuite = 'numerics'\n"));
    expectFailure(run({"experiment", "run", "suite.toml", "--shard", "1/2"}), 2, {"--shard"});
    expectFailure(run({"experiment", "run", "study.toml", "more.toml"}), 2, {"more.toml"});
    expectFailure(run({"experiment", "run", "study.toml", "--incomplete"}), 2, {"--incomplete"});
    expectFailure(merge({"nowhere"}), 1, {"nowhere", "experiment.json"});
    expectFailure(merge({"a", "b"}, {}), 2, {"--out"});
    expectFailure(merge({"a"}, {"--shard", "1/2"}), 2, {"--shard"});
    EXPECT_EQ(files(), (std::set<std::string>{"study.toml", "suite.toml", "wavy.toml"}));
}

TEST_F(ExperimentShards, DoNotGoIntoAFolderThatAWholeStudyWritesInto) {
    fs::create_directory(folder / "out");
    const int other = ::open((folder / "out").c_str(), O_RDONLY | O_DIRECTORY);
    ASSERT_EQ(::flock(other, LOCK_EX), 0);
    expectFailure(shard("1/2"), 2, {"--out", "another experiment"});
    ASSERT_EQ(::flock(other, LOCK_SH), 0);
    doShard("1/2");
    expectFailure(run(study()), 2, {"--out", "another experiment"});
    ::close(other);
}

}  // namespace
}  // namespace kaustik::test
