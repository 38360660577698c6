// SPDX-License-Identifier: MIT
// 'kaustik experiment report': figures, and a page that is used in headless Chromium as a reader
// would.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "framework/image/image.h"
#include "tests/cli/experiment_fixture.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Results as a study with a reference leaves them, made up: two configurations, two repeats, and
// pictures of a blob that one of them gets wrong.
class ExperimentReport : public CommandLine {
  protected:
    void writeResults() const {
        fs::create_directory(folder / "out");
        json runs = json::array();
        json samples = json::array();
        std::ofstream table(folder / "out/runs.csv");
        table << "folder,hash,repeat,status,message,trace.epsilon,frame_ms.median,"
                 "pass:layers.peel,pass:trace.lines,error.caustic_irradiance.rel_mse,"
                 "hits.agreement_visible,device\n";
        for (int configuration = 0; configuration < 2; ++configuration) {
            const std::string hash(32, configuration == 0 ? 'a' : 'b');
            const double epsilon = configuration == 0 ? 0.001 : 0.1;
            runs.push_back({{"hash", hash},
                            {"axes", {{"trace.epsilon", epsilon}}},
                            {"products", json::array({0})}});
            for (int repeat = 1; repeat <= 2; ++repeat) {
                const std::string name = repeat == 1 ? hash : hash + "-r2";
                const double ms = 4.0 + 3.0 * configuration + 0.1 * repeat;
                table << fmt::format("{},{},{},done,,{},{},1,{},{},{},\"<b>, a device\"\n", name,
                                     hash, repeat, epsilon, ms, ms - 2.0,
                                     configuration == 0 ? 0.05 : 0.002,
                                     configuration == 0 ? 0.9 : 0.99);
                samples.push_back({{"hash", hash},
                                   {"repeat", repeat},
                                   {"frame_samples_ms", {ms - 0.2, ms, ms + 0.3}},
                                   {"passes", json::array()}});
                writePictures(name, configuration == 0 ? 0.6f : 1.0f);
            }
        }
        table << std::string(32, 'c') << "," << std::string(32, 'c')
              << ",1,failed,out of memory; use fewer photons.,0.2,,,,,,\n";
        const json axis = {{"key", "trace.epsilon"},
                           {"unit", "m"},
                           {"description", "How near is a hit"},
                           {"products", json::array({0})}};
        const json experiment = {{"schema", "kaustik.experiment/1"},
                                 {"version", "0.1.0"},
                                 {"name", "made-up"},
                                 {"description", "A <script>study</script> & more."},
                                 {"repeats", 2},
                                 {"axes", json::array({axis})},
                                 {"runs", runs}};
        static_cast<void>(folder.file("out/experiment.json", experiment.dump()));
        static_cast<void>(folder.file("out/samples.json", json{{"runs", samples}}.dump()));
    }

    void writePictures(const std::string& name, float brightness) const {
        Image reference(32, 24, 3);
        Image caustic(32, 24, 3);
        for (int y = 0; y < 24; ++y) {
            for (int x = 0; x < 32; ++x) {
                const float blob =
                    500.0f * std::exp(-0.02f * static_cast<float>((x - 16) * (x - 16) +
                                                                  (y - 12) * (y - 12)));
                for (int c = 0; c < 3; ++c) {
                    reference.at(x, y, c) = blob;
                    caustic.at(x, y, c) = brightness * blob;
                }
            }
        }
        fs::create_directory(folder / ("out/" + name));
        writeImage(folder / ("out/" + name + "/reference.pfm"), reference);
        writeImage(folder / ("out/" + name + "/caustic.pfm"), caustic);
    }

    [[nodiscard]] Outcome draw(Conditions conditions = {}) const {
        return run({"experiment", "report", "out"}, std::move(conditions));
    }
};

TEST_F(ExperimentReport, DrawsEveryFigureForScreenAndPaperAndSaysSo) {
    writeResults();
    const Outcome outcome = draw();
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    std::set<std::string> expected = {"out/report.html", "out/summary.csv", "out/summary.tex"};
    for (const char* name :
         {"speed-error-caustic-irradiance-rel-mse", "speed-hits-agreement-visible", "passes",
          "sweep-trace-epsilon", "frame-times", "pictures"}) {
        for (const char* suffix : {"svg", "pdf", "png"})
            expected.insert(fmt::format("out/figures/{}.{}", name, suffix));
    }
    for (const std::string& file : expected) {
        EXPECT_TRUE(files().contains(file)) << file;
        EXPECT_NE(outcome.out.find("wrote " + file + "\n"), std::string::npos) << outcome.out;
    }
    for (const std::string& file : files())
        EXPECT_FALSE(file.ends_with(".part")) << file;
}

TEST_F(ExperimentReport, IsAPageThatWorksOfflineByKeyboardAndMouse) {
    writeResults();
    ASSERT_EQ(draw().exitCode, 0);
    const fs::path problems = folder / "problems.txt";
    const std::string command =
        fmt::format("/usr/bin/python3 -B {} {} > {} 2>&1", KAUSTIK_PAGE_IN_BROWSER,
                    (folder / "out/report.html").string(), problems.string());
    EXPECT_EQ(std::system(command.c_str()), 0) << contents("problems.txt");
}

TEST_F(ExperimentReport, ShowsNamesAsTextAndFailuresByTheirMessage) {
    writeResults();
    ASSERT_EQ(draw().exitCode, 0);
    const std::string page = contents("out/report.html");
    EXPECT_NE(page.find("A &lt;script&gt;study&lt;/script&gt; &amp; more."), std::string::npos);
    EXPECT_EQ(page.find("<script>study"), std::string::npos);
    EXPECT_NE(page.find("&lt;b&gt;, a device"), std::string::npos);
    EXPECT_NE(page.find("out of memory; use fewer photons."), std::string::npos);
    EXPECT_EQ(page.find("http://"), std::string::npos);
    EXPECT_EQ(page.find("https://"), std::string::npos);
}

TEST_F(ExperimentReport, SummarizesOverRepeats) {
    writeResults();
    ASSERT_EQ(draw().exitCode, 0);
    const std::string summary = contents("out/summary.csv");
    // 4.1 and 4.2 ms: their mean, and their standard deviation 0.1/√2.
    EXPECT_NE(summary.find("aaaaaaaa,0.001,2,4.15 ± 0.071"), std::string::npos) << summary;
}

TEST_F(ExperimentReport, SummarizesOverSeeds) {
    writeResults();
    json experiment = json::parse(contents("out/experiment.json"));
    experiment["axes"][0]["key"] = "seed";
    for (std::size_t i = 0; i < experiment["runs"].size(); ++i)
        experiment["runs"][i]["axes"] = {{"seed", 1 + i}};
    static_cast<void>(folder.file("out/experiment.json", experiment.dump()));
    ASSERT_EQ(draw().exitCode, 0);
    const std::string summary = contents("out/summary.csv");
    // 4.1, 4.2, 7.1 and 7.2 ms in one row.
    EXPECT_NE(summary.find("\naaaaaaaa,4,5.65 ± 1.7,"), std::string::npos) << summary;
    EXPECT_EQ(summary.find("bbbbbbbb"), std::string::npos) << summary;
}

TEST_F(ExperimentReport, NeverAveragesTimesOfDifferentDevices) {
    writeResults();
    // The second repeats were requeued to a machine with another device.
    std::string table = contents("out/runs.csv");
    for (std::size_t at = table.find("-r2"); at != std::string::npos;
         at = table.find("-r2", at + 1)) {
        table.replace(table.find("<b>, a device", at), 13, "another device");
    }
    static_cast<void>(folder.file("out/runs.csv", table));
    const Outcome outcome = draw();
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const std::string summary = contents("out/summary.csv");
    EXPECT_NE(summary.find("\naaaaaaaa,0.001,1,1,4.1,"), std::string::npos) << summary;
    EXPECT_NE(summary.find("\naaaaaaaa,0.001,2,1,4.2,"), std::string::npos) << summary;
    EXPECT_EQ(summary.find("4.15"), std::string::npos) << summary;
    // Nor are they drawn together.
    for (const char* name : {"speed-error-caustic-irradiance-rel-mse", "passes",
                             "sweep-trace-epsilon", "frame-times"}) {
        EXPECT_TRUE(files().contains(fmt::format("out/figures/{}-device-1.svg", name))) << name;
        EXPECT_TRUE(files().contains(fmt::format("out/figures/{}-device-2.svg", name))) << name;
        EXPECT_FALSE(files().contains(fmt::format("out/figures/{}.svg", name))) << name;
    }
    const std::string page = contents("out/report.html");
    EXPECT_NE(page.find("1: &lt;b&gt;, a device; 2: another device"), std::string::npos);
}

TEST_F(ExperimentReport, WithoutMatplotlibNamesThePackage) {
    writeResults();
    fs::create_directory(folder / "broken");
    static_cast<void>(folder.file("broken/matplotlib.py", "raise ImportError('none')\n"));
    Conditions without;
    without.environment = {{"PYTHONPATH", (folder / "broken").string()}};
    expectFailure(draw(without), 1, {"matplotlib", "install", "python3-matplotlib"});
}

TEST_F(ExperimentReport, WithoutPythonNamesThePackages) {
    writeResults();
    Conditions without;
    without.environment = {{"KAUSTIK_PYTHON", "/nonexistent/python3"}};
    expectFailure(draw(without), 1, {"/nonexistent/python3", "python3-matplotlib"});
}

// A Python that is called by a bare name takes the modules of the first of that name on the path.
TEST_F(ExperimentReport, TakesNoModulesOfAnotherPython) {
    writeResults();
    for (const char* part : {"other", "other/bin", "other/lib"})
        fs::create_directory(folder / part);
    static_cast<void>(folder.file("other/bin/python3", "#!/bin/false\n"));
    fs::permissions(folder / "other/bin/python3", fs::perms::owner_all);
    for (int minor = 9; minor < 20; ++minor) {
        const std::string modules = fmt::format("other/lib/python3.{}", minor);
        fs::create_directory(folder / modules);
        static_cast<void>(folder.file(modules + "/os.py", ""));
    }
    Conditions first;
    first.environment = {{"PATH", (folder / "other/bin").string() + ":" + std::getenv("PATH")}};
    const Outcome outcome = draw(first);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
}

TEST_F(ExperimentReport, OfADamagedFolderSaysWhichFile) {
    writeResults();
    static_cast<void>(folder.file("out/experiment.json", "{\"schema\": "));
    expectFailure(draw(), 1, {"out/experiment.json", "JSON"});
}

TEST_F(ExperimentReport, OfFailuresAloneSaysThatThereIsNothingToDraw) {
    writeResults();
    static_cast<void>(folder.file("out/runs.csv", "folder,hash,repeat,status,message\n"));
    expectFailure(draw(), 1, {"out/runs.csv", "no finished run"});
}

class ReportOfARealStudy : public ExperimentCommand {};

TEST_F(ReportOfARealStudy, ShowsTimesAndPicturesThoughThereIsNoReference) {
    ASSERT_EQ(run(study()).exitCode, 0);
    const Outcome outcome = run({"experiment", "report", "out"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("warning"), std::string::npos) << outcome.out;
    for (const char* name : {"passes", "sweep-layers-count", "pictures"}) {
        EXPECT_TRUE(files().contains(fmt::format("out/figures/{}.svg", name))) << name;
    }
    EXPECT_TRUE(files().contains("out/report.html"));
}

}  // namespace
}  // namespace kaustik::test
