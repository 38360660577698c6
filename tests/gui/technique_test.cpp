// SPDX-License-Identifier: MIT
// The panel Technique: other nodes, and two variants side by side.
#include <algorithm>
#include <set>

#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

// 8 bits, of a hit whose distance two tracers round differently.
constexpr double kTwoSteps = 2.01 / 255.0;

class TechniquePanel : public WorkbenchTest {
  protected:
    [[nodiscard]] double split() { return std::stod(bench->value("picture.split")); }
    // The columns of the seen picture left (or right) of the split, without the line itself.
    [[nodiscard]] Image imageOfSide(bool isLeft) {
        const Image all = seenPicture();
        const int at = static_cast<int>(split() * all.width);
        return isLeft ? columns(all, 0, at - 4) : columns(all, at + 60, all.width);
    }
};

TEST_F(TechniquePanel, AnotherTracerRunsAndFindsTheSamePicture) {
    start();
    const Image before = seenPicture();
    open("Technique");
    bench->keepScreenshot("technique");
    EXPECT_FALSE(bench->has("reset.trace"));
    choose("stage.trace", "march");
    untilSettled();
    EXPECT_EQ(document().at("variant").at("set").at("trace"), "march");
    open("Passes");
    EXPECT_EQ(bench->value("passes.name.trace.march"), "ran");
    EXPECT_FALSE(bench->has("passes.name.trace.hierarchical"));
    EXPECT_LE(largestDifference(seenPicture(), before), kTwoSteps);

    open("Technique");
    bench->click("reset.trace");
    untilSettled();
    EXPECT_FALSE(document().at("variant").at("set").contains("trace"));
    open("Passes");
    EXPECT_EQ(bench->value("passes.name.trace.hierarchical"), "ran");
    EXPECT_EQ(largestDifference(seenPicture(), before), 0.0);
}

TEST_F(TechniquePanel, ANodeThatIsTheOnlyOneOfItsStageCannotBeChosen) {
    start();
    open("Technique");
    bench->click("stage.eye");
    EXPECT_FALSE(bench->has("stage.eye=surfaces"));
}

// A stage comes where its last pass does.
TEST_F(TechniquePanel, StagesAreThoseOfTheRegistryInTheOrderOfAFrame) {
    start();
    open("Technique");
    std::vector<std::pair<double, std::string>> found;
    const json controls = bench->screen().at("controls");
    for (const auto& [name, control] : controls.items()) {
        if (name.starts_with("stage."))
            found.emplace_back(control.at("y").get<double>(), name.substr(6));
    }
    std::sort(found.begin(), found.end());
    std::vector<std::string> stages;
    for (const auto& [y, name] : found)
        stages.push_back(name);
    std::set<std::string> registered;
    for (const json& node : json::parse(run({"list", "nodes", "--json"}).out))
        registered.insert(node.at("stage"));
    EXPECT_EQ(std::set<std::string>(stages.begin(), stages.end()), registered);

    renderSmall({"--out", "report"});
    std::vector<std::string> expected;
    const json report = readJson("report/report.json");
    for (const json& pass : report.at("passes")) {
        const std::string name = pass.at("name");
        const std::string stage = name.substr(0, name.find('.'));
        if (name == "reconstruct.pixel_blocks") continue;  // what is left to do in the end
        if (name == "geometry.embree") continue;           // where it is first asked for
        std::erase(expected, stage);
        expected.push_back(stage);
    }
    // These have no pass of their own here.
    for (const char* stage : {"driver", "refine", "around", "filter", "temporal"})
        EXPECT_EQ(std::erase(stages, stage), 1u) << stage;
    EXPECT_EQ(stages, expected);
}

TEST_F(TechniquePanel, TheVariantThatIsEditedIsNamedWhereverItIs) {
    json both = smallDocument();
    both["other"] = both["variant"];
    both["other"]["set"]["trace.epsilon"] = "0.25";
    start(savedStateWith(both));
    EXPECT_TRUE(bench->value("picture.caption").starts_with("A: picture"));
    EXPECT_EQ(bench->value("parameters.edit_a"), "on");
    EXPECT_EQ(bench->value("parameter.trace.epsilon"), "0.01");
    bench->click("parameters.edit_b");
    EXPECT_EQ(bench->value("parameter.trace.epsilon"), "0.25");
    EXPECT_TRUE(bench->value("picture.caption").starts_with("B: picture"));
    bench->keepScreenshot("technique-edit-b");
    EXPECT_EQ(bench->value("passes.edit_b"), "on");
    open("Technique");
    EXPECT_EQ(bench->value("variant.edit_b"), "on");
    for (const auto& [tab, panel] : {std::pair{"Image", "image"}, std::pair{"Error", "error"}}) {
        open(tab);
        EXPECT_EQ(bench->value(std::string(panel) + ".edit_b"), "on");
    }
    // What is not there needs no name.
    bench->click("variant.drop");
    EXPECT_FALSE(bench->has("passes.edit_a"));
    EXPECT_TRUE(bench->value("picture.caption").starts_with("picture"));
}

TEST_F(TechniquePanel, TwoVariantsAreSeenSideBySide) {
    start();
    const Image lit = seenPicture();
    open("Technique");
    bench->click("variant.keep");
    open("Passes");
    switchPass("compose.direct");
    untilSettled();
    open("Technique");
    EXPECT_EQ(document().at("variant").at("disable"), json({"compose.direct"}));
    EXPECT_EQ(document().at("other").at("disable"), json::array());
    bench->keepScreenshot("technique-side-by-side");
    // B is as it was; A, left of the split, has lost its light.
    const Image right = imageOfSide(false);
    EXPECT_EQ(largestDifference(right, columns(lit, lit.width - right.width, lit.width)), 0.0);
    const Image left = imageOfSide(true);
    EXPECT_LT(meanOf(left), 0.5 * meanOf(columns(lit, 0, left.width)));
    EXPECT_GT(std::stod(bench->value("variant.table")), 0.0);

    const double before = split();
    const double pixels = bench->control("picture.image").w;
    bench->drag("picture.split", -100, 0, kLeftButton, {0.5, 0.9});
    EXPECT_NEAR(split(), before - 100.0 / pixels, 2.0 / pixels);
    const Image wider = imageOfSide(false);
    EXPECT_NEAR(wider.width, right.width + 100, 2);
    EXPECT_EQ(largestDifference(wider, columns(lit, lit.width - wider.width, lit.width)), 0.0);
    EXPECT_FALSE(document().at("edits").contains("camera")) << "the hand held the split";

    // Times go with what they are of, at once, and nothing is rendered again.
    open("Passes");
    const std::string timeOfA = bench->value("passes.frame");
    open("Technique");
    const std::string timeOfB = bench->value("variant.table");
    bench->click("variant.swap");
    EXPECT_EQ(bench->value("variant.table"), timeOfA);
    untilSettled();
    EXPECT_EQ(bench->value("variant.table"), timeOfA);
    open("Passes");
    EXPECT_EQ(bench->value("passes.frame"), timeOfB);
    open("Technique");
    EXPECT_EQ(document().at("variant").at("disable"), json::array());
    const Image swapped = imageOfSide(true);
    EXPECT_EQ(largestDifference(swapped, columns(lit, 0, swapped.width)), 0.0);

    bench->click("variant.edit_b");
    open("Passes");
    // Where reasons take several lines, the last rows are out of sight.
    bench->wheel("passes.on.emit.grid", -20);
    EXPECT_EQ(bench->value("passes.on.compose.direct"), "off");
    open("Technique");
    bench->click("variant.drop");
    untilSettled();
    EXPECT_FALSE(document().contains("other"));
    EXPECT_FALSE(bench->has("picture.split"));
    EXPECT_EQ(largestDifference(seenPicture(), lit), 0.0);
}

}  // namespace
}  // namespace kaustik::test
