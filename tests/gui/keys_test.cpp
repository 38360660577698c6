// SPDX-License-Identifier: MIT
// Short cuts on keyboards whose keys say other things than a US one's.
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class Keyboards : public WorkbenchTest, public testing::WithParamInterface<const char*> {
  protected:
    Keyboards() { desktop.setLayout(GetParam()); }
    void changeEpsilon() {
        bench->typeInto("parameter.trace.epsilon", "0.25", Entry::controlClick);
    }
};

INSTANTIATE_TEST_SUITE_P(Of, Keyboards, testing::Values("us", "fr", "de"),
                         [](const auto& layout) { return std::string(layout.param); });

TEST_P(Keyboards, InAFieldCtrlASelectsAllAndNothingElse) {
    start();
    bench->click("parameters.search");
    bench->type("march");
    bench->key("ctrl+a");
    ASSERT_TRUE(bench->isRunning());
    bench->type("x");
    EXPECT_EQ(bench->value("parameters.search"), "x");
}

TEST_P(Keyboards, UndoAndRedoAreZAndY) {
    start();
    const json before = document();
    changeEpsilon();
    const json after = document();
    ASSERT_NE(before, after);
    bench->key("ctrl+z");
    EXPECT_EQ(document(), before);
    bench->key("ctrl+y");
    EXPECT_EQ(document(), after);
}

TEST_P(Keyboards, SignsAndDigitsAreWhereverTheyArePrinted) {
    json kept = savedStateWith(smallDocument());
    kept["view"]["resource"] = "caustic.irradiance";
    kept["view"]["looks"]["caustic.irradiance"] = {{"exposure_automatic", false}};
    kept["panels"]["sequence_step"] = 0.25;
    start(kept);
    open("Image");
    bench->hover("picture");
    bench->key("+");
    EXPECT_EQ(bench->value("image.exposure"), "0.5");
    bench->key("-");
    bench->key("-");
    EXPECT_EQ(bench->value("image.exposure"), "-0.5");
    bench->key(".");
    EXPECT_NEAR(document().at("edits").at("time").get<double>(), 0.25, 1e-6);
    const double whole = bench->control("picture.image").w;
    bench->wheel("picture", 2);
    EXPECT_GT(bench->control("picture.image").w, whole);
    bench->key("0");
    EXPECT_EQ(bench->control("picture.image").w, whole);
}

// The four keys that fly lie together: a French keyboard has Z Q S D there.
TEST_P(Keyboards, LettersAreWhereverTheyArePrintedAndFlyingGoesByPlace) {
    start();
    bench->hover("picture");
    const bool isFrench = std::string(GetParam()) == "fr";
    bench->key(isFrench ? "z" : "w");
    const json edits = document().at("edits");
    ASSERT_TRUE(edits.contains("camera"));
    // Forward, which is down to the water.
    EXPECT_LT(edits.at("camera").at("position").at(1).get<double>(), 2.0);
    bench->key("r");
    EXPECT_FALSE(document().at("edits").contains("camera"));
    bench->keyDown("ctrl");
    bench->keyDown("q");
    EXPECT_EQ(bench->wait().exitCode, 0);
}

TEST_P(Keyboards, WhileOneTypesOnlyFunctionKeysAreCommands) {
    start();
    changeEpsilon();
    const json changed = document();
    bench->click("parameters.search");
    bench->type("wasdqerlfp0.+- ");
    for (const char* chord : {"ctrl+s", "ctrl+z", "ctrl+y", "ctrl+q"})
        bench->key(chord);
    ASSERT_TRUE(bench->isRunning());
    EXPECT_EQ(document(), changed);
    EXPECT_EQ(bench->status().at("message"), "");
    EXPECT_EQ(bench->status().at("playing"), false);
    bench->key("F1");
    EXPECT_TRUE(bench->has("help"));
}

class AKeyboard : public WorkbenchTest {};

TEST_F(AKeyboard, MayChangeItsLayoutWhileTheWorkbenchRuns) {
    start();
    const json before = document();
    bench->typeInto("parameter.trace.epsilon", "0.25", Entry::controlClick);
    desktop.setLayout("de");
    bench->key("ctrl+z");
    EXPECT_EQ(document(), before);
    desktop.setLayout("us");
    bench->key("ctrl+y");
    EXPECT_NE(document(), before);
}

}  // namespace
}  // namespace kaustik::test
