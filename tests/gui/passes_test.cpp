// SPDX-License-Identifier: MIT
// The panel Passes: what ran, in which order, what it cost, and switching it off.
#include <algorithm>
#include <map>

#include "framework/core/files.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class PassesPanel : public WorkbenchTest {
  protected:
    // Names of passes on the screen that have a control of that kind, from top to bottom.
    [[nodiscard]] std::vector<std::string> passesWith(const std::string& prefix) {
        std::vector<std::pair<double, std::string>> found;
        const json controls = bench->screen().at("controls");
        for (const auto& [name, control] : controls.items()) {
            if (name.starts_with(prefix))
                found.emplace_back(control.at("y").get<double>(), name.substr(prefix.size()));
        }
        std::sort(found.begin(), found.end());
        std::vector<std::string> names;
        for (auto& [y, name] : found)
            names.push_back(std::move(name));
        return names;
    }
    // "" where it isn't on the screen.
    [[nodiscard]] std::string state(const std::string& pass) {
        return bench->has("passes.name." + pass) ? bench->value("passes.name." + pass) : "";
    }
};

// Where a line is too short for a reason it takes more, within the panel.
TEST_F(PassesPanel, ReasonsTakeAsManyLinesAsTheyNeed) {
    json kept = savedStateWith(smallDocument());
    kept["panels"]["left"] = 220;
    start(kept);
    const double end = bench->control("picture.pane").x;
    double tallest = 0.0;
    const json screen = bench->screen();
    for (const auto& [name, area] : screen.at("controls").items()) {
        if (!name.starts_with("passes.why.")) continue;
        EXPECT_LE(area.at("x").get<double>() + area.at("w").get<double>(), end) << name;
        tallest = std::max(tallest, area.at("h").get<double>());
    }
    EXPECT_GE(tallest, 2.0 * 13.0) << "two lines";
}

// The list is a report's, which another process writes of the same scene and settings.
TEST_F(PassesPanel, ListsTheGraphInItsOrderWithTheReasonsOfWhatWasSkipped) {
    start();
    bench->keepScreenshot("passes");
    renderSmall({"--out", "report"});
    std::vector<std::string> all;
    const json report = readJson("report/report.json");
    for (const json& pass : report.at("passes"))
        all.push_back(pass.at("name"));
    // The table is longer than its panel: a first part without gaps, then the rest.
    const std::vector<std::string> seen = passesWith("passes.name.");
    ASSERT_GE(seen.size(), 15u);
    EXPECT_TRUE(std::equal(seen.begin(), seen.end(), all.begin()));
    EXPECT_EQ(state("media.lines"), "skipped");
    EXPECT_EQ(bench->value("passes.why.media.lines"), "the scene has no medium that scatters");
    EXPECT_FALSE(bench->has("passes.on.media.lines"));

    bench->wheel("passes.name.trace.hierarchical", -20);
    const std::vector<std::string> rest = passesWith("passes.name.");
    ASSERT_LE(rest.size(), all.size());
    EXPECT_TRUE(std::equal(rest.rbegin(), rest.rend(), all.rbegin()));
    EXPECT_EQ(state("compose.display"), "ran");
    EXPECT_GE(seen.size() + rest.size(), all.size());
    bench->keepScreenshot("passes-end");
}

TEST_F(PassesPanel, HasATimeForEachPassThatRan) {
    start();
    const double frame = std::stod(bench->value("passes.frame"));
    for (const std::string& pass : passesWith("passes.name.")) {
        ASSERT_EQ(bench->has("passes.median." + pass), state(pass) == "ran") << pass;
        if (state(pass) != "ran") continue;
        const double time = std::stod(bench->value("passes.median." + pass));
        EXPECT_GT(time, 0.0) << pass;
        EXPECT_LT(time, frame) << pass;
    }
    EXPECT_EQ(bench->value("chart"), std::to_string(bench->status().at("frame").get<int>()));
}

TEST_F(PassesPanel, APassThatIsSwitchedOffChangesThePictureAndCostsNothing) {
    start();
    const Image before = seenPicture();
    const std::vector<std::string> timed = passesWith("passes.median.");
    switchPass("compose.direct");
    untilSettled();
    const Image without = seenPicture();
    bench->keepScreenshot("passes-off");
    EXPECT_EQ(document().at("variant").at("disable"), json({"compose.direct"}));
    EXPECT_EQ(state("compose.direct"), "bypassed");
    EXPECT_EQ(bench->value("passes.on.compose.direct"), "off");
    EXPECT_NE(bench->value("passes.why.compose.direct").find("'direct.irradiance' is 0"),
              std::string::npos);
    bench->wheel("passes.on.compose.direct", 20);
    // Light is only taken away.
    EXPECT_LT(meanOf(without), 0.5 * meanOf(before));
    EXPECT_GT(meanOf(without), 0.0) << "the caustic stays";
    // Shadows were looked up for it alone.
    std::vector<std::string> expected = timed;
    std::erase(expected, "compose.direct");
    std::erase(expected, "shadow.map");
    std::erase(expected, "shadow.lookup");
    // Of those that the table has room for, before and after.
    std::vector<std::string> now = passesWith("passes.median.");
    const std::size_t rows = std::min(now.size(), expected.size());
    ASSERT_GE(rows, 10u);
    now.resize(rows);
    expected.resize(rows);
    EXPECT_EQ(now, expected);
    EXPECT_EQ(state("shadow.map"), "culled");
    EXPECT_NE(bench->value("passes.why.shadow.map").find("nothing asks for"), std::string::npos);

    switchPass("compose.direct");
    untilSettled();
    EXPECT_EQ(largestDifference(seenPicture(), before), 0.0);
    bench->wheel("passes.on.compose.direct", 20);
    EXPECT_EQ(passesWith("passes.median."), timed);
}

// Thumbnails are made of the frame that is there, and so is the texture that one of them opens.
TEST_F(PassesPanel, AClickOnAPassShowsItsInputsAndOutputsWithoutRendering) {
    start();
    const int frame = bench->status().at("frame");
    bench->click("passes.name.trace.hierarchical");
    bench->waitFor("thumbnails", [](const json& screen) {
        const json& controls = screen.at("controls");
        return controls.contains("pass.reads.layers.depth") &&
               controls.at("pass.reads.layers.depth").at("value") == "thumbnail";
    });
    bench->keepScreenshot("pass-detail");
    EXPECT_EQ(bench->value("pass.close"), "trace.hierarchical");
    bench->click("pass.reads.layers.depth");
    untilSettled();
    EXPECT_TRUE(bench->value("picture.caption").starts_with("layers.depth"));
    EXPECT_EQ(bench->status().at("frame"), frame) << "nothing was rendered";
    EXPECT_EQ(bench->value("shown"), "asked");
    // Its parameters, and those of its stage, are in reach: the detail is longer than its pane.
    const auto found = [&](const std::string& control) {
        for (int tries = 0; tries < 20 && !bench->has(control); ++tries)
            bench->wheel("pass.body", -2);
        return bench->has(control);
    };
    EXPECT_TRUE(found("pass.writes.hits.position_1"));
    open("Image");  // so that only one panel has parameters
    EXPECT_TRUE(found("parameter.trace.hierarchical.steps"));
    EXPECT_FALSE(bench->has("parameter.layers.count"));
    bench->keepScreenshot("pass-detail-parameters");
}

TEST_F(PassesPanel, TheGraphIsAPictureOfTheSamePasses) {
    start();
    bench->key("g");
    ASSERT_TRUE(bench->has("graph"));
    EXPECT_FALSE(bench->has("picture"));
    // The list of `kaustik explain --dot`: all but what was skipped.
    run({"explain", "wavy.toml", "--size", "64x48", "--technique", "screen_space_photons", "--set",
         "emit.photons=32x32", "--set", "shadow.map.size=64", "--dot", "passes.dot"});
    const std::string dot = readFile(folder / "passes.dot");
    std::map<std::string, double> columns;
    std::size_t boxes = 0;
    const json controls = bench->screen().at("controls");
    for (const auto& [control, area] : controls.items()) {
        const std::string name = control.substr(std::min(control.find('.') + 1, control.size()));
        if (!control.starts_with("graph.") || name == "back") continue;
        ++boxes;
        const std::size_t at = dot.find("label=\"" + name + "\"");
        ASSERT_NE(at, std::string::npos) << name;
        const std::string end = dot.substr(at, dot.find('\n', at) - at);
        EXPECT_EQ(area.at("value") == "culled", end.find("gray") != std::string::npos) << end;
        const std::string stage = name.substr(0, name.find('.'));
        const double x = area.at("x");
        EXPECT_EQ(columns.emplace(stage, x).first->second, x) << "stages are columns";
    }
    EXPECT_GE(boxes, 8u) << "others are beyond the edge of the pane";
    EXPECT_GE(columns.size(), 4u);
    bench->keepScreenshot("passes-graph");
    bench->click("graph.eye.receivers");
    EXPECT_EQ(bench->value("pass.close"), "eye.receivers");
    bench->keepScreenshot("passes-graph-chosen");
    bench->click("graph.back");
    EXPECT_TRUE(bench->has("picture"));
}

// A mark where settings have changed, with what that has cost; an axis and a legend.
TEST_F(PassesPanel, TheTimeChartMarksWhereSettingsHaveChanged) {
    start();
    EXPECT_FALSE(bench->has("chart.mark.1"));
    EXPECT_TRUE(bench->value("chart.axis").ends_with("ms"));
    // It names the stages that take most, whichever those are on this device.
    int named = 0;
    for (const std::string stage : {"geometry", "eye", "layers", "emit", "trace", "view"}) {
        if (!bench->has("chart.legend." + stage)) continue;
        ++named;
        EXPECT_GT(std::stod(bench->value("chart.legend." + stage)), 0.0) << stage;
    }
    EXPECT_GE(named, 3);
    const int before = std::stoi(bench->value("chart"));
    open("Parameters");
    bench->typeInto("parameter.layers.count", "2", Entry::controlClick);
    untilSettled();
    ASSERT_TRUE(bench->has("chart.mark.1"));
    EXPECT_TRUE(says("chart.mark.1", "layers.count default → 2"));
    EXPECT_TRUE(says("chart.mark.1", "\nframe: "));
    EXPECT_GT(std::stoi(bench->value("chart")), before);
    bench->hover("chart.mark.1");
    bench->keepScreenshot("time-chart");
    // The camera is no setting.
    bench->drag("picture", 30, 0);
    untilSettled();
    EXPECT_FALSE(bench->has("chart.mark.2"));
}

TEST_F(PassesPanel, ARequiredPassStaysOn) {
    start();
    const json before = bench->status();
    bench->click("passes.on.eye.receivers");
    EXPECT_EQ(bench->value("passes.on.eye.receivers"), "on");
    EXPECT_EQ(document(), before.at("document"));
    EXPECT_EQ(bench->status().at("order"), before.at("order"));
}

TEST_F(PassesPanel, FramesGoOnWhileTheyAreAskedFor) {
    start();
    bench->click("passes.endless");
    const int before = bench->status().at("frame");
    bench->waitFor("forty more frames", [&](const json& screen) {
        return screen.at("status").at("frame").get<int>() > before + 40;
    });
    bench->click("passes.endless");
    untilSettled();
    const int after = bench->status().at("frame");
    bench->untilTaken();
    EXPECT_EQ(bench->status().at("frame"), after);
}

}  // namespace
}  // namespace kaustik::test
