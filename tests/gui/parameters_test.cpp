// SPDX-License-Identifier: MIT
// The panel Parameters: values typed, dragged, found and taken back.
#include <cmath>

#include "framework/image/image.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class ParametersPanel : public WorkbenchTest {
  protected:
    [[nodiscard]] json set() { return document().at("variant").at("set"); }
    // Waits until it is set.
    [[nodiscard]] std::string onceSet(const std::string& parameter) {
        bench->waitFor("a value of " + parameter, [&](const json& screen) {
            return screen.at("status").at("document").at("variant").at("set").contains(parameter);
        });
        return set().at(parameter);
    }
    [[nodiscard]] std::set<std::string> shown() {
        std::set<std::string> names;
        const json controls = bench->screen().at("controls");
        for (const auto& [name, control] : controls.items()) {
            if (name.starts_with("parameter.")) names.insert(name.substr(10));
        }
        return names;
    }
};

TEST_F(ParametersPanel, AValueThatIsTypedIsMarkedAndCanBeTakenBack) {
    start();
    EXPECT_FALSE(bench->has("reset.trace.epsilon"));
    bench->typeInto("parameter.trace.epsilon", "0.25", Entry::controlClick);
    untilSettled();
    EXPECT_EQ(set().at("trace.epsilon"), "0.25");
    EXPECT_EQ(bench->value("parameter.trace.epsilon"), "0.25");
    ASSERT_TRUE(bench->has("reset.trace.epsilon"));
    bench->keepScreenshot("parameters");
    bench->click("reset.trace.epsilon");
    EXPECT_FALSE(set().contains("trace.epsilon"));
    EXPECT_FALSE(bench->has("reset.trace.epsilon"));
    EXPECT_EQ(bench->value("parameter.trace.epsilon"), "0.01");
}

TEST_F(ParametersPanel, AValueThatIsNoNumberIsRefusedWithASentence) {
    start();
    bench->typeInto("parameter.trace.epsilon", "0,05", Entry::controlClick);
    EXPECT_FALSE(set().contains("trace.epsilon"));
    EXPECT_EQ(bench->value("parameter.trace.epsilon"), "0.01");
    ASSERT_TRUE(bench->has("problem.trace.epsilon"));
    EXPECT_NE(bench->value("problem.trace.epsilon").find("cannot be '0,05'"), std::string::npos)
        << bench->value("problem.trace.epsilon");
    bench->keepScreenshot("parameters-problem");
    bench->typeInto("parameter.trace.epsilon", "0.05", Entry::controlClick);
    EXPECT_EQ(set().at("trace.epsilon"), "0.05");
    EXPECT_FALSE(bench->has("problem.trace.epsilon"));
}

TEST_F(ParametersPanel, AValueOutOfRangeBecomesTheNearestWithin) {
    start();
    bench->typeInto("parameter.layers.count", "1000", Entry::controlClick);
    EXPECT_EQ(set().at("layers.count"), "64");
    EXPECT_NE(bench->value("problem.layers.count").find("of 1000 it has taken 64"),
              std::string::npos);
    bench->typeInto("parameter.layers.count", "-3", Entry::controlClick);
    EXPECT_EQ(set().at("layers.count"), "1");
    untilSettled();  // rows move as the new frame says what has an effect
    bench->typeInto("parameter.emit.photons", "0", Entry::click, "Return", {0.2, 0.5});
    EXPECT_EQ(set().at("emit.photons"), "1x32");
    untilSettled();
    EXPECT_EQ(bench->status().at("problem"), "");
}

TEST_F(ParametersPanel, ASliderThatIsDraggedChangesThePicture) {
    start();
    const Image before = seenPicture();
    // To the left end: one layer, the water's surface, which leaves the photons no floor to hit.
    bench->drag("parameter.layers.count", -400, 0, kLeftButton, {0.14, 0.5});
    untilSettled();
    EXPECT_EQ(set().at("layers.count"), "1");
    EXPECT_GT(largestDifference(seenPicture(), before), 0.1);
}

// A straight slider's would be 50, of which a frame takes a minute.
TEST_F(ParametersPanel, TheMiddleOfAWideRangeIsAUsualValue) {
    start();
    bench->click("parameter.reconstruct.triangles.tolerance");
    const double tolerance = std::stod(onceSet("reconstruct.triangles.tolerance"));
    EXPECT_NEAR(tolerance, std::sqrt(0.01 * 10.0), 0.05) << "a few of the slider's pixels";
    bench->typeInto("parameter.layers.count", "2", Entry::controlClick);
    bench->click("parameter.layers.count");
    EXPECT_NEAR(std::stod(bench->value("parameter.layers.count")), 8.0, 1.0)
        << "which may be its default";
    untilSettled();  // rows move as the new frame says what has an effect
    bench->click("parameter.trace.hierarchical.steps");
    EXPECT_LT(std::stod(bench->value("parameter.trace.hierarchical.steps")), 100.0);
    // The end that means "as many as needed" is there, too.
    bench->drag("parameter.trace.hierarchical.steps", -400, 0);
    EXPECT_EQ(onceSet("trace.hierarchical.steps"), "0");
}

// As another process renders it with the same value.
TEST_F(ParametersPanel, AChangedParameterMeansWhatItMeansOnTheCommandLine) {
    start();
    choose("parameter.reconstruct.triangles.shading", "flat");
    bench->typeInto("parameter.emit.photons", "16", Entry::click, "Return", {0.2, 0.5});
    bench->typeInto("parameter.emit.photons", "24", Entry::click, "Return", {0.8, 0.5});
    untilSettled();
    EXPECT_EQ(set().at("emit.photons"), "16x24");
    open("Record");
    bench->click("record.report");
    untilRecorded();
    renderSmall({"--set", "emit.photons=16x24", "--set", "reconstruct.triangles.shading=flat",
                 "--out", "expected"});
    std::filesystem::path written;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out"))
        written = entry.path();
    EXPECT_EQ(readImage(written / ("caustic" + floatImageExtension())).values,
              readImage(folder / "expected" / ("caustic" + floatImageExtension())).values);
}

TEST_F(ParametersPanel, TheSearchLeavesOnlyWhatMatches) {
    start();
    const std::set<std::string> all = shown();
    EXPECT_GT(all.size(), 15u);
    bench->typeInto("parameters.search", "EPSilon");
    // By its name, and by a sentence that speaks of epsilon.
    EXPECT_TRUE(shown().contains("trace.epsilon"));
    for (const std::string& name : shown())
        EXPECT_EQ(name.substr(0, 6), "trace.") << name;
    bench->keepScreenshot("parameters-search");
    bench->typeInto("parameters.search", "no such thing");
    EXPECT_TRUE(shown().empty());
    bench->typeInto("parameters.search", "march");
    EXPECT_TRUE(shown().empty()) << "that node is not in use";
    bench->click("parameters.all");
    EXPECT_TRUE(shown().contains("trace.march.steps"));
}

// What the document was begun with, what is changed by hand, and a node that is chosen; a value
// that is typed and is the default is none of it.
TEST_F(ParametersPanel, ChangedLeavesJustWhatDiffersFromTheDefault) {
    start();
    bench->click("parameters.changed");
    EXPECT_EQ(shown(), (std::set<std::string>{"emit.photons", "shadow.map.size"}));
    bench->click("parameters.changed");
    bench->typeInto("parameter.trace.epsilon", "0.01", Entry::controlClick);
    bench->typeInto("parameter.layers.count", "3", Entry::controlClick);
    open("Technique");
    choose("stage.driver", "hierarchical");
    bench->click("parameters.changed");
    EXPECT_EQ(shown(),
              (std::set<std::string>{"driver", "emit.photons", "layers.count", "shadow.map.size"}));
    bench->keepScreenshot("parameters-changed");
    bench->click("reset.layers.count");
    EXPECT_FALSE(shown().contains("layers.count"));
    EXPECT_FALSE(set().contains("layers.count"));
}

// The reason is that of `kaustik explain`, word by word.
TEST_F(ParametersPanel, WhatHasNoEffectSaysWhyAsExplainDoes) {
    start();
    bench->typeInto("parameters.search", "reconstruct.map_size");
    EXPECT_EQ(bench->value("parameters.left_out"), "1");
    EXPECT_TRUE(shown().empty());
    bench->click("parameters.all");
    EXPECT_FALSE(bench->has("parameters.left_out"));
    ASSERT_TRUE(bench->has("no_effect.reconstruct.map_size"));
    const std::string sentence = bench->value("no_effect.reconstruct.map_size");
    EXPECT_EQ(sentence, "reconstruct.map_size has no effect: light is stored on the screen.");
    EXPECT_NE(run({"explain", "wavy.toml", "--technique", "screen_space_photons"})
                  .out.find("light is stored on the screen: reconstruct.map_size"),
              std::string::npos);
    bench->hover("parameter.reconstruct.map_size");
    bench->keepScreenshot("parameters-no-effect");
    bench->typeInto("parameters.search", "emit.photons");
    EXPECT_TRUE(bench->has("parameter.emit.photons"));
    EXPECT_FALSE(bench->has("no_effect.emit.photons"));
}

TEST_F(ParametersPanel, TheParametersOfAChosenNodeAppear) {
    start();
    EXPECT_FALSE(bench->has("parameter.specular.split.levels"));
    open("Technique");
    choose("stage.specular", "split");
    EXPECT_TRUE(bench->has("parameter.specular.split.levels"));
}

// Settings that no other driver reads are not there to be turned in vain.
TEST_F(ParametersPanel, OfRefinementAppearWithADriverThatRefines) {
    start();
    EXPECT_FALSE(bench->has("parameter.refine.tolerance"));
    EXPECT_FALSE(bench->has("parameter.reconstruct.map_size")) << "light is stored on the screen";
    open("Technique");
    choose("stage.driver", "hierarchical");
    EXPECT_TRUE(bench->has("parameter.refine.tolerance"));
}

// As `explain` does: only the frame knows whether so few layers are made by lists.
TEST_F(ParametersPanel, OfANodeThatTheFrameDoesWithoutAreNotThere) {
    start();
    EXPECT_TRUE(bench->has("parameter.layers.lists.memory"));
    bench->typeInto("parameter.layers.count", "1", Entry::controlClick);
    untilSettled();
    EXPECT_FALSE(bench->has("parameter.layers.lists.memory"));
}

}  // namespace
}  // namespace kaustik::test
