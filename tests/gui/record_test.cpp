// SPDX-License-Identifier: MIT
// The panel Record: pictures, reports and experiments that can be done again without the workbench.
#include <fmt/format.h>

#include <algorithm>

#include "framework/core/files.h"
#include "framework/image/image.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class RecordPanel : public WorkbenchTest {
  protected:
    // What is in the folder "out" and ends so, in order.
    [[nodiscard]] std::vector<fs::path> recorded(const std::string& ending) const {
        std::vector<fs::path> found;
        if (!fs::exists(folder / "out")) return found;
        for (const auto& entry : fs::recursive_directory_iterator(folder / "out")) {
            if (entry.path().string().ends_with(ending)) found.push_back(entry.path());
        }
        std::sort(found.begin(), found.end());
        return found;
    }
    // Of the report that was written last.
    [[nodiscard]] fs::path reportFolder() const {
        return recorded("report.json").back().parent_path();
    }
    void saveReport() {
        open("Record");
        bench->click("record.report");
        untilRecorded();
    }
    // What `kaustik experiment run` makes of the experiment that was saved last, by run.
    [[nodiscard]] std::vector<fs::path> runExperiment() const {
        std::vector<fs::path> files = recorded(".toml");
        std::erase_if(files,
                      [](const fs::path& file) { return file.string().ends_with("-scene.toml"); });
        EXPECT_EQ(files.size(), 1u);
        run({"experiment", "run", files.back().string(), "--out", "again"});
        std::vector<fs::path> runs;
        for (const auto& entry : fs::recursive_directory_iterator(folder / "again")) {
            if (entry.path().filename() == "run.json") runs.push_back(entry.path().parent_path());
        }
        return runs;
    }
    static void expectSameImages(const fs::path& a, const fs::path& b) {
        for (const std::string name : {"caustic", "beauty"}) {
            const std::string file = name + floatImageExtension();
            const Image one = readImage(a / file);
            EXPECT_GT(meanOf(one), 0.0);
            // Pixels, since an .exr also has the time at which it was written.
            EXPECT_EQ(one.values, readImage(b / file).values) << file;
        }
    }
};

TEST_F(RecordPanel, ASequenceHasAWholePictureForEachMoment) {
    json kept = savedStateWith(smallDocument());
    kept["panels"]["sequence_frames"] = 3;
    kept["panels"]["sequence_step"] = 0.25;
    start(kept);
    open("Record");
    bench->click("record.sequence");
    untilRecorded();
    bench->keepScreenshot("record");
    EXPECT_TRUE(says("record.state", "Wrote 3 pictures"));
    const std::vector<fs::path> files = recorded(displayImageExtension());
    ASSERT_EQ(files.size(), 3u);
    for (std::size_t i = 0; i < files.size(); ++i) {
        EXPECT_EQ(files[i].filename(), fmt::format("{:04}{}", i, displayImageExtension()));
        const std::string out = fmt::format("moment-{}", i);
        renderSmall({"--time", fmt::format("{}", 0.25 * static_cast<double>(i)), "--out", out});
        const Image expected = readImage(folder / out / ("beauty" + displayImageExtension()));
        EXPECT_EQ(readImage(files[i]).values, expected.values) << i;
        EXPECT_TRUE(i == 0 || readImage(files[i]).values != readImage(files[i - 1]).values) << i;
    }
}

TEST_F(RecordPanel, ASequenceThatIsCancelledLeavesWholePictures) {
    json kept = savedStateWith(smallDocument());
    kept["panels"]["sequence_frames"] = 100000;
    start(kept);
    open("Record");
    bench->click("record.sequence");
    bench->waitFor("the third picture", [](const json& screen) {
        return screen.at("controls")
            .at("record.state")
            .at("value")
            .get<std::string>()
            .starts_with("busy: picture 3");
    });
    bench->click("record.cancel");
    untilRecorded();
    const std::vector<fs::path> files = recorded(displayImageExtension());
    EXPECT_TRUE(says("record.state", fmt::format("Cancelled after {} of", files.size())))
        << bench->value("record.state");
    EXPECT_LT(files.size(), 100000u);
    for (const fs::path& file : files)
        EXPECT_EQ(readImage(file).width, 64);
    // The picture comes back.
    untilSettled();
    EXPECT_EQ(bench->status().at("error"), "");
}

TEST_F(RecordPanel, AReportHasPassesTimesAndATrace) {
    start();
    saveReport();
    const fs::path written = reportFolder();
    const json report = json::parse(readFile(written / "report.json"));
    EXPECT_EQ(report.at("size"), json({64, 48}));
    EXPECT_EQ(report.at("frames"), 8);
    EXPECT_GT(report.at("frame_ms").at("median").get<double>(), 0.0);
    EXPECT_GT(report.at("passes").size(), 15u);
    EXPECT_GT(json::parse(readFile(written / "trace.json")).at("traceEvents").size(), 15u);
    renderSmall({"--out", "expected"});
    expectSameImages(written, folder / "expected");
}

TEST_F(RecordPanel, AReportHasErrorAndHitsAsARunHas) {
    start();
    open("Record");
    EXPECT_EQ(bench->value("record.judged"), "off");
    bench->click("record.judged");
    saveReport();
    ASSERT_TRUE(says("record.state", "Wrote ")) << bench->value("record.state");
    const json report = json::parse(readFile(reportFolder() / "report.json"));
    renderSmall({"--reference", "auto", "--reference-photons", "1000000", "--out", "judged"});
    const json expected = readJson("judged/report.json");
    ASSERT_TRUE(expected.at("error").contains("modelled_paths"));
    EXPECT_EQ(report.at("error"), expected.at("error"));
    EXPECT_EQ(report.at("hits"), expected.at("hits"));
    EXPECT_TRUE(fs::exists(reportFolder() / ("error" + displayImageExtension())));
    // The picture goes on.
    untilSettled();
    EXPECT_EQ(bench->value("shown"), "asked");
}

TEST_F(RecordPanel, AReportIsCancelledWhileItsReferenceIsComputed) {
    json kept = savedStateWith(smallDocument());
    kept["panels"]["judged_reports"] = true;
    kept["panels"]["truth_photons"] = 1e11;  // for days
    start(kept);
    open("Record");
    bench->click("record.report");
    bench->waitFor("a reference on its way", [](const json& screen) {
        return screen.at("controls")
            .at("record.state")
            .at("value")
            .get<std::string>()
            .starts_with("busy: reference");
    });
    bench->click("record.cancel");
    untilRecorded();
    EXPECT_TRUE(says("record.state", "cancelled")) << bench->value("record.state");
    EXPECT_TRUE(fs::is_empty(folder / "out")) << "a folder without a file is left";
    untilSettled();
    EXPECT_EQ(bench->status().at("error"), "");
}

TEST_F(RecordPanel, AScreenshotIsOfTheWholeWindow) {
    start();
    const Image seen = seenPicture();
    bench->key("F12");
    bench->waitFor("a written screenshot", [](const json& screen) {
        return screen.at("status").at("message").get<std::string>().starts_with("Wrote ");
    });
    const std::vector<fs::path> files = recorded(displayImageExtension());
    ASSERT_EQ(files.size(), 1u);
    const Image shot = readImage(files[0]);
    EXPECT_EQ(shot.width, 1440);
    EXPECT_EQ(shot.height, 900);
    const Rectangle place = bench->control("picture.image");
    Image part(seen.width, seen.height, 3);
    for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < part.width; ++x) {
            for (int c = 0; c < 3; ++c)
                part.at(x, y, c) =
                    shot.at(x + static_cast<int>(place.x), y + static_cast<int>(place.y), c);
        }
    }
    // The same bytes, of which two ways make floats.
    EXPECT_LT(largestDifference(part, seen), 1e-6);
}

TEST_F(RecordPanel, ASavedExperimentGivesTheSameImagesToTheBit) {
    json kept = savedStateWith(smallDocument());
    kept["view"]["shows_lights"] = true;
    start(kept);
    bench->drag("light.sun", -40, 5);
    bench->drag("picture", 70, 30, kLeftButton, {0.2, 0.9});
    switchPass("compose.direct");
    bench->typeInto("parameter.reconstruct.triangles.tolerance", "0.3", Entry::controlClick);
    open("Technique");
    choose("stage.trace", "march");
    open("Scene");
    bench->click("scene.step");
    bench->click("scene.header.water");
    bench->typeInto("scene.wave.water.0.amplitude", "0.013", Entry::controlClick, "Return",
                    {0.2, 0.5});
    untilSettled();
    const json changed = document();
    for (const char* key : {"camera", "lights", "time", "waves"})
        ASSERT_TRUE(changed.at("edits").contains(key)) << key;
    ASSERT_EQ(changed.at("variant").at("disable"), json({"compose.direct"}));
    bench->key("ctrl+s");
    EXPECT_TRUE(says("status.message", "kaustik experiment run"));
    bench->keepScreenshot("record-experiment");
    saveReport();
    const std::vector<fs::path> runs = runExperiment();
    ASSERT_EQ(runs.size(), 1u);
    expectSameImages(runs[0], reportFolder());
}

// So that its errors are those that were seen.
TEST_F(RecordPanel, ASavedExperimentTakesTheReferenceAlong) {
    json kept = savedStateWith(smallDocument());
    kept["panels"]["judged_reports"] = true;
    start(kept);
    open("Error");
    bench->click("error.compute");
    bench->waitFor("a reference", [](const json& screen) {
        return screen.at("status").at("truth_photons").get<double>() >= 1e6 &&
               screen.at("status").at("judged_order") != 0;
    });
    open("Record");
    bench->click("record.experiment");
    EXPECT_TRUE(says("status.message", "errors by its reference"));
    saveReport();
    const json expected = json::parse(readFile(reportFolder() / "report.json")).at("error");
    ASSERT_TRUE(expected.at("caustic_irradiance").at("rel_mse").is_number());
    const std::vector<fs::path> runs = runExperiment();
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_EQ(json::parse(readFile(runs[0] / "report.json")).at("error"), expected);
}

TEST_F(RecordPanel, TwoVariantsAreTwoRunsOfAnExperiment) {
    json small = smallDocument();
    small["other"] = small["variant"];
    small["other"]["set"]["emit.photons"] = "16x16";
    small["other"]["set"]["reconstruct.triangles.shading"] = "flat";
    small["other"]["disable"] = {"compose.direct"};
    start(savedStateWith(small));
    open("Record");
    bench->click("record.experiment");
    const std::vector<fs::path> runs = runExperiment();
    ASSERT_EQ(runs.size(), 2u);
    renderSmall({"--out", "a"});
    renderSmall({"--set", "emit.photons=16x16", "--set", "reconstruct.triangles.shading=flat",
                 "--disable", "compose.direct", "--out", "b"});
    const std::string file = "caustic" + floatImageExtension();
    const bool isFirstA = readImage(runs[0] / file).values == readImage(folder / "a" / file).values;
    expectSameImages(runs[isFirstA ? 0 : 1], folder / "a");
    expectSameImages(runs[isFirstA ? 1 : 0], folder / "b");
}

TEST_F(RecordPanel, NumbersAreTakenAsTypedOrItIsSaid) {
    start();
    open("Record");
    const std::string before = bench->value("record.frames");
    bench->typeInto("record.frames", "1,5", Entry::click, "Return", {0.2, 0.5});
    EXPECT_EQ(bench->value("record.frames"), before);
    EXPECT_TRUE(says("status.message", "pictures takes a whole number"))
        << bench->value("status.message");
    bench->typeInto("record.step", "0.0005", Entry::controlClick, "Return", {0.2, 0.5});
    EXPECT_EQ(bench->value("record.step"), "0.0005");
    bench->typeInto("record.step", "20", Entry::controlClick, "Return", {0.2, 0.5});
    EXPECT_EQ(bench->value("record.step"), "10");
    EXPECT_TRUE(says("status.message", "of 20 it has taken 10")) << bench->value("status.message");
}

TEST_F(RecordPanel, AFolderThatCannotBeWrittenIsSaidSo) {
    static_cast<void>(folder.file("occupied", "a file"));
    start();
    open("Record");
    bench->typeInto("record.folder", "occupied/below");
    bench->click("record.experiment");
    EXPECT_TRUE(says("status.message", "occupied"));
    bench->click("record.report");
    untilRecorded();
    EXPECT_TRUE(says("record.state", "occupied"));
    EXPECT_FALSE(says("record.state", "--out"));
    bench->keepScreenshot("record-refused");
    EXPECT_TRUE(says("status.message", "occupied"));
    bench->typeInto("record.folder", "out");
    EXPECT_EQ(bench->status().at("message"), "") << "the folder is another one";
    EXPECT_EQ(bench->value("record.state"), "idle: ");
    untilSettled();
    EXPECT_EQ(bench->status().at("error"), "");
}

}  // namespace
}  // namespace kaustik::test
