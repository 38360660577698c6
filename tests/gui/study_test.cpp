// SPDX-License-Identifier: MIT
// The panel Study: settings to vary, their runs in the background, and the way to each of them.
#include <fmt/format.h>

#include <algorithm>

#include "framework/core/files.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class StudyPanel : public WorkbenchTest {
  protected:
    void vary(const std::string& key) { choose("study.vary", key); }
    // Starts a study of three numbers of layers, without errors.
    void runOfLayers(int frames) {
        json kept = savedStateWith(smallDocument());
        kept["panels"]["study"] = json::array({json::array({"layers.count", "1 2 4"})});
        kept["panels"]["study_frames"] = frames;
        kept["panels"]["judged_studies"] = false;
        start(kept);
        open("Study");
        bench->click("study.run");
    }
    // Waits until the study's progress says that, or until it is over.
    void untilStudy(const std::string& part) {
        std::string said;
        bench->waitFor("the study's progress", [&](const json& screen) {
            const json& controls = screen.at("controls");
            if (!controls.contains("study.progress")) return false;
            said = controls.at("study.progress").at("value").get<std::string>();
            return said.find(part) != std::string::npos || said.starts_with("idle: ");
        });
        EXPECT_NE(said.find(part), std::string::npos) << said << bench->screen().at("controls");
    }
    // Of the one study that was written.
    [[nodiscard]] fs::path experiment() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(folder / "out")) {
            if (entry.path().extension() == ".toml") found.push_back(entry.path());
        }
        EXPECT_EQ(found.size(), 1u);
        return found.front();
    }
    // Of the run with these values of the study that was done.
    [[nodiscard]] json reportOf(const json& values) const {
        fs::path results = experiment();
        results.replace_extension();
        for (const auto& entry : fs::directory_iterator(results)) {
            if (!fs::exists(entry.path() / "run.json")) continue;
            const json run = json::parse(readFile(entry.path() / "run.json"));
            const json& parameters = run.at("settings").at("parameters");
            const bool isIt = std::all_of(
                values.items().begin(), values.items().end(),
                [&](const auto& item) { return parameters.at(item.key()) == item.value(); });
            if (isIt) return json::parse(readFile(entry.path() / "report.json"));
        }
        ADD_FAILURE() << "there is no run of " << values;
        return {};
    }
};

TEST_F(StudyPanel, RunsWhatIsVariedAndAClickOpensARun) {
    start();
    open("Study");
    EXPECT_TRUE(says("study.plan", "Choose what is to be varied"));
    vary("layers.count");
    EXPECT_TRUE(says("study.plan", "1 run, about ")) << bench->value("study.plan");
    bench->typeInto("study.values.layers.count", "1 many");
    EXPECT_TRUE(says("study.problem.layers.count", "many"));
    bench->typeInto("study.values.layers.count", "1, 4 4");
    EXPECT_TRUE(says("study.plan", "2 runs, about ")) << bench->value("study.plan");
    vary("trace");
    EXPECT_EQ(bench->value("study.value.trace.hierarchical"), "on");
    bench->click("study.value.trace.march");
    EXPECT_TRUE(says("study.plan", "4 runs, about "));
    EXPECT_TRUE(says("study.plan", "a reference of 1 million photons"));
    bench->typeInto("study.frames", "2", Entry::click, "Return", {0.2, 0.5});
    const json before = document();
    bench->keepScreenshot("study-planned");
    bench->click("study.run");
    untilStudy(" more");  // how long the others take, once one is done
    // The window goes on meanwhile, and what it shows is what it was.
    EXPECT_EQ(document(), before);
    EXPECT_EQ(bench->value("shown"), "asked");
    untilStudy("idle: 4 of 4 runs");
    EXPECT_EQ(bench->value("study.plot"), "4 points");
    EXPECT_TRUE(says("study.row.2", "layers.count=1, trace=march"));
    bench->keepScreenshot("study");

    // What a shell would have found, error and all.
    const json report = reportOf({{"layers.count", 1}, {"trace", "march"}});
    EXPECT_EQ(report.at("frames"), 2);
    renderSmall({"--set", "layers.count=1", "--set", "trace=march", "--reference", "auto",
                 "--reference-photons", "1000000", "--out", "expected"});
    EXPECT_EQ(report.at("error"), readJson("expected/report.json").at("error"));

    bench->click("study.row.2");
    untilSettled();
    EXPECT_EQ(document().at("variant").at("set").at("layers.count"), "1");
    EXPECT_EQ(document().at("variant").at("set").at("trace"), "march");
    // Without layers photons are lost, by any tracer.
    EXPECT_GT(reportOf({{"layers.count", 1}, {"trace", "march"}})
                  .at("error")
                  .at("caustic_irradiance")
                  .at("rel_mse")
                  .get<double>(),
              reportOf({{"layers.count", 4}, {"trace", "march"}})
                  .at("error")
                  .at("caustic_irradiance")
                  .at("rel_mse")
                  .get<double>());
    // What was set up is there the next time.
    endByClosing();
    startAgain();
    open("Study");
    EXPECT_TRUE(says("study.plan", "4 runs"));
    bench->click("study.drop.trace");
    EXPECT_TRUE(says("study.plan", "2 runs"));
}

TEST_F(StudyPanel, IsCancelledAndSaysHowItGoesOn) {
    runOfLayers(4000);
    untilStudy("busy: 0 of 3 runs");
    EXPECT_TRUE(bench->has("study.cancel"));
    bench->click("study.cancel");
    untilStudy("idle: ");
    EXPECT_TRUE(says("study.remark", "--resume` does the rest")) << bench->value("study.remark");
    EXPECT_FALSE(bench->has("study.cancel"));
    untilSettled();
}

TEST_F(StudyPanel, ThatEndsWithTheWindowSaysHowItGoesOn) {
    runOfLayers(4000);
    bench->waitFor("the experiment's file", [&](const json&) {
        return std::filesystem::exists(folder / "out") &&
               std::filesystem::directory_iterator(folder / "out") !=
                   std::filesystem::directory_iterator();
    });
    untilStudy("busy: 0 of 3 runs");
    bench->close();
    const Outcome outcome = bench->wait();
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_NE(outcome.err.find("\nkaustik experiment run "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("--resume\n"), std::string::npos) << outcome.err;
}

TEST_F(StudyPanel, WhoseFolderIsRemovedMeanwhileHasNoResults) {
    runOfLayers(60);
    untilStudy("busy: 1 of 3 runs");
    fs::path results = experiment();
    results.replace_extension();
    fs::remove(results / "experiment.json");
    std::error_code ignored;  // the next run may be writing
    fs::remove_all(results, ignored);
    untilStudy("idle: ");
    EXPECT_TRUE(says("study.remark", "was removed")) << bench->value("study.remark");
}

TEST_F(StudyPanel, AFolderThatCannotBeWrittenIsSaidSo) {
    static_cast<void>(folder.file("occupied", "a file"));
    json kept = savedStateWith(smallDocument());
    kept["panels"]["record_folder"] = "occupied/below";
    kept["panels"]["study"] = json::array({json::array({"layers.count", "1 2"})});
    kept["panels"]["judged_studies"] = false;
    start(kept);
    open("Study");
    bench->click("study.run");
    untilStudy("idle: 0 of 2 runs");
    EXPECT_TRUE(says("study.remark", "occupied")) << bench->value("study.remark");
    EXPECT_FALSE(bench->has("study.cancel"));
    bench->keepScreenshot("study-refused");
    open("Record");
    bench->typeInto("record.folder", "out");
    open("Study");
    EXPECT_FALSE(bench->has("study.remark")) << "the folder is another one";
}

TEST_F(StudyPanel, IsSavedWithoutBeingRun) {
    json kept = savedStateWith(smallDocument());
    kept["panels"]["study"] =
        json::array({json::array({"technique", "screen_space_photons exact_rays"})});
    start(kept);
    open("Study");
    bench->click("study.save");
    EXPECT_TRUE(says("status.message", "kaustik experiment run"));
    const std::string text = readFile(experiment());
    EXPECT_NE(text.find(R"(technique = ["screen_space_photons", "exact_rays"])"), std::string::npos)
        << text;
    EXPECT_NE(text.find("reference_photons = 1000000"), std::string::npos) << text;
    EXPECT_FALSE(bench->has("study.progress"));
}

}  // namespace
}  // namespace kaustik::test
