// SPDX-License-Identifier: MIT
// The workbench as a whole: starting, keeping, closing, keys, and where it cannot be.
#include <algorithm>
#include <set>

#include "framework/core/files.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Workbench : public WorkbenchTest {
  protected:
    // Of which a frame takes long: the interface is seen to go on in the meantime.
    static json slowDocument() {
        json slow = smallDocument();
        slow["size"] = {400, 300};
        slow["variant"]["set"]["emit.photons"] = "768x768";
        return slow;
    }
    void startWithoutWaiting(const json& kept) {
        writeSavedState(kept);
        bench.emplace(desktop, folder / "");
    }
    [[nodiscard]] static json documentIn(const json& screen) {
        return screen.at("status").at("document");
    }
};

// Nothing is kept yet, and all is as shipped but for the scene: the default one's mesh may be
// missing.
TEST_F(Workbench, TheFirstStartShowsAPicture) {
    bench.emplace(desktop, folder / "", std::vector<std::string>{"flat-water"});
    bench->waitFor("a first picture", [](const json& screen) {
        return screen.at("controls").contains("picture.image");
    });
    EXPECT_EQ(document().at("size"), json({800, 600}));
    EXPECT_EQ(document().at("variant").at("set"), json::object());
    EXPECT_EQ(bench->status().at("rendered_scene"), "flat-water");
    EXPECT_GT(meanOf(seenPicture()), 0.05);
    EXPECT_EQ(bench->value("tab.Passes"), "open");
    EXPECT_TRUE(bench->has("tab.Parameters"));
    bench->keepScreenshot("workbench-first");
}

TEST_F(Workbench, WhereNothingIsSeenYetAQuickPictureComesFirst) {
    startWithoutWaiting(savedStateWith(slowDocument()));
    bench->waitFor("a first picture", [](const json& screen) {
        return screen.at("controls").contains("picture.image");
    });
    const json first = bench->screen();
    EXPECT_EQ(first.at("controls").at("picture").at("value"), "preview");
    EXPECT_EQ(first.at("controls").at("shown").at("value"), "preview");
    EXPECT_EQ(first.at("status").at("frame"), 0) << "none of those that are timed";
    bench->keepScreenshot("workbench-quick-picture");
    bench->waitFor("a whole picture", [](const json& screen) {
        return screen.at("controls").at("picture").at("value") == "whole";
    });
    EXPECT_EQ(bench->value("shown"), "asked");
}

TEST_F(Workbench, TheProgressOfAnOrderNeverGoesBack) {
    json document = smallDocument();
    document["size"] = {240, 180};
    document["variant"]["set"]["emit.photons"] = "256x256";
    startWithoutWaiting(savedStateWith(document));
    json order;
    double maximum = 0.0;
    std::set<double> seen;
    bench->waitFor("a settled picture", [&](const json& screen) {
        const json& status = screen.at("status");
        if (status.at("order") != order) maximum = 0.0;
        order = status.at("order");
        const json& controls = screen.at("controls");
        if (controls.contains("toolbar.progress")) {
            const double share =
                std::stod(controls.at("toolbar.progress").at("value").get<std::string>());
            EXPECT_GE(share, maximum);
            EXPECT_LE(share, 1.0);
            maximum = share;
            seen.insert(share);
        }
        return status.at("settled") == true && status.at("rendered_order") == order;
    });
    EXPECT_GT(seen.size(), 5u);
}

TEST_F(Workbench, ARestartFindsEverythingAsItWasLeft) {
    start();
    bench->drag("picture", 90, 20);
    bench->typeInto("parameter.trace.epsilon", "0.25", Entry::controlClick);
    switchPass("compose.direct");
    open("Image");
    choose("image.texture", "caustic.irradiance");
    untilSettled();  // the look is that of the image that is seen
    bench->key("f");
    open("Scene");
    bench->click("scene.step");
    bench->drag("splitter.right_edge", -60, 0);
    untilSettled();
    const json before = document();
    const double edge = bench->control("splitter.right_edge").x;
    const Image seen = seenPicture();
    endByClosing();

    startAgain();
    EXPECT_EQ(document(), before);
    EXPECT_EQ(before.at("variant").at("set").at("trace.epsilon"), "0.25");
    EXPECT_TRUE(before.at("edits").contains("camera"));
    EXPECT_NEAR(bench->control("splitter.right_edge").x, edge, 1.0);
    EXPECT_EQ(largestDifference(seenPicture(), seen), 0.0);
    open("Image");
    EXPECT_EQ(bench->value("image.texture"), "caustic.irradiance");
    EXPECT_EQ(bench->value("image.false_color"), "on");
}

TEST_F(Workbench, WhatWasKeptBeforeACrashIsThereAgain) {
    start();
    bench->typeInto("parameter.trace.epsilon", "0.25", Entry::controlClick);
    const json changed = document();
    // Nothing more is touched: it keeps by itself.
    bench->waitFor("a file with the change",
                   [&](const json&) { return readSavedState().at("document") == changed; });
    bench->kill();
    startAgain();
    EXPECT_EQ(document(), changed);
    EXPECT_EQ(bench->value("parameter.trace.epsilon"), "0.25");
}

TEST_F(Workbench, SettingsThatMakeNoSenseAreNoReasonNotToStart) {
    const fs::path file = folder / "config/kaustik/workbench.json";
    fs::create_directories(file.parent_path());
    const std::string damaged =
        R"({"view": {"zoom": "x", "compared_with": 99}, "document": 7, "panels": [)";
    writeFileWhole(file, damaged);
    bench.emplace(desktop, folder / "", std::vector<std::string>{"wavy.toml"});
    bench->waitFor("a picture", [](const json& screen) {
        return screen.at("controls").contains("picture.image");
    });
    EXPECT_EQ(bench->status().at("scene"), "wavy.toml");
    // The file is no reason to lose what is in it.
    const fs::path aside = file.parent_path() / "workbench-damaged-1.json";
    EXPECT_TRUE(says("status.message", aside.string())) << bench->value("status.message");
    EXPECT_EQ(readFile(aside), damaged);
    bench->keepScreenshot("workbench-damaged-settings");
    endByClosing();
    EXPECT_EQ(readSavedState().at("document").at("scene"), "wavy.toml");

    json kept = savedStateWith(smallDocument());
    kept["document"]["variant"]["set"]["no.such.parameter"] = "1";
    start(kept);
    EXPECT_TRUE(says("status.message", "no.such.parameter"));
    EXPECT_EQ(document().at("scene"), "wavy.toml");
    EXPECT_EQ(json::parse(readFile(file.parent_path() / "workbench-damaged-2.json")), kept);
}

TEST_F(Workbench, TheInterfaceGoesOnWhileAFrameIsRendered) {
    startWithoutWaiting(savedStateWith(slowDocument()));
    bench->waitFor("a first picture", [](const json& screen) {
        return screen.at("controls").contains("picture.image");
    });
    bench->click("passes.endless");
    json first;
    int maximum = 0;
    bench->waitFor("five frames of the interface during one of the picture", [&](const json& now) {
        const bool isSameFrame = !first.is_null() && now.at("status").at("busy") == true &&
                                 now.at("status").at("frame") == first.at("status").at("frame");
        if (!isSameFrame) first = now;
        maximum = std::max(maximum, now.at("frame").get<int>() - first.at("frame").get<int>());
        return maximum >= 5;
    });
    // An order in the middle of a frame is taken at once.
    bench->click("passes.endless");
    bench->typeInto("parameter.emit.photons", "16", Entry::click, "Return", {0.2, 0.5});
    EXPECT_EQ(document().at("variant").at("set").at("emit.photons"), "16x768");
}

TEST_F(Workbench, ClosingInTheMiddleOfAFrameLosesNothing) {
    startWithoutWaiting(savedStateWith(slowDocument()));
    bench->waitFor("a frame that is being rendered", [](const json& screen) {
        return screen.at("status").at("busy") == true &&
               screen.at("controls").contains("picture.image");
    });
    bench->drag("picture", 40, 0);
    const json changed = document();
    ASSERT_TRUE(changed.at("edits").contains("camera"));
    endByClosing();
    EXPECT_EQ(readSavedState().at("document"), changed);
}

TEST_F(Workbench, ClosingInTheMiddleOfARecordingEndsWell) {
    json kept = savedStateWith(smallDocument());
    kept["panels"]["sequence_frames"] = 100000;
    start(kept);
    open("Record");
    bench->click("record.sequence");
    bench->waitFor("a picture", [](const json& screen) {
        return screen.at("controls")
            .at("record.state")
            .at("value")
            .get<std::string>()
            .starts_with("busy: picture");
    });
    endByClosing();
}

TEST_F(Workbench, CtrlQEndsIt) {
    start();
    bench->keyDown("ctrl");
    bench->keyDown("q");
    EXPECT_EQ(bench->wait().exitCode, 0);
}

TEST_F(Workbench, KeysAreListedWithF1) {
    start();
    bench->key("F1");
    ASSERT_TRUE(bench->has("help"));
    bench->keepScreenshot("workbench-keys");
    bench->key("F1");
    EXPECT_FALSE(bench->has("help"));
    bench->click("toolbar.keys");
    EXPECT_TRUE(bench->has("help"));
}

TEST_F(Workbench, ChangesAreUndoneAndDoneAgain) {
    start();
    const json first = document();
    bench->typeInto("parameter.trace.epsilon", "0.25", Entry::controlClick);
    const json second = document();
    bench->drag("picture", 50, 10);
    // A step is kept with the first frame in which nothing is held down.
    untilSettled();
    const json third = document();
    switchPass("compose.direct");
    untilSettled();
    const json fourth = document();
    for (const json& before : {third, second, first, first}) {
        bench->key("ctrl+z");
        EXPECT_EQ(document(), before) << "a drag is one step";
    }
    untilSettled();
    for (const json& after : {second, third, fourth, fourth}) {
        bench->key("ctrl+y");
        EXPECT_EQ(document(), after);
    }
    bench->click("toolbar.undo");
    EXPECT_EQ(document(), third);
    bench->key("ctrl+shift+z");
    EXPECT_EQ(document(), fourth);
    // In a field the keys are the text's.
    bench->click("parameters.search");
    bench->type("abc");
    bench->key("ctrl+z");
    EXPECT_EQ(document(), fourth);
}

TEST_F(Workbench, TypingInAFieldIsNoCommand) {
    start();
    bench->click("parameters.search");
    const json before = document();
    bench->type("rflp 0.-+");
    EXPECT_EQ(bench->value("parameters.search"), "rflp 0.-+");
    EXPECT_EQ(document(), before);
    EXPECT_EQ(bench->status().at("playing"), false);
}

TEST_F(Workbench, TooMuchMemoryIsExplainedAndAfterwardsItGoesOn) {
    start();
    json modest = document();
    bench->typeInto("parameter.emit.photons", "4096", Entry::click, "Return", {0.2, 0.5});
    bench->typeInto("parameter.layers.count", "64", Entry::controlClick);
    open("Scene");
    bench->typeInto("scene.size", "16384", Entry::click, "Return", {0.1, 0.5});
    bench->typeInto("scene.size", "16384", Entry::click, "Return", {0.5, 0.5});
    bench->waitFor("the problem", [](const json& screen) {
        return screen.at("controls").contains("status.problem");
    });
    bench->keepScreenshot("workbench-memory");
    EXPECT_TRUE(says("status.problem", "Use fewer photons, layers or pixels"))
        << bench->value("status.problem");
    // The window lives on.
    for (int step = 0; step < 8 && document() != modest; ++step)
        bench->key("ctrl+z");
    EXPECT_EQ(document(), modest);
    if (bench->has("status.restart")) bench->click("status.restart");
    untilSettled();
    EXPECT_FALSE(bench->has("status.problem"));
    EXPECT_GT(meanOf(seenPicture()), 0.1);
}

TEST_F(Workbench, ASmallWindowKeepsAPicture) {
    json kept = savedStateWith(smallDocument());
    kept["window"] = {{"width", 640}, {"height", 400}, {"x", 20}, {"y", 30}};
    start(kept);
    bench->keepScreenshot("workbench-small");
    const Rectangle picture = bench->control("picture");
    EXPECT_GT(picture.w, 60.0);
    EXPECT_GT(picture.h, 60.0);
    EXPECT_LE(picture.x + picture.w, 640.0);
}

// Twice as many pixels for the same thing, but for the picture, which keeps its own.
TEST_F(Workbench, OnADenseScreenEverythingIsLarger) {
    start();
    const Rectangle tab = bench->control("tab.Passes");
    const Rectangle button = bench->control("toolbar.one_to_one");
    const Rectangle before = bench->control("picture");
    bench.reset();

    desktop.setDensity(192);
    start();
    bench->keepScreenshot("workbench-dense");
    for (const auto& [name, small] :
         {std::pair{"tab.Passes", tab}, std::pair{"toolbar.one_to_one", button}}) {
        EXPECT_NEAR(bench->control(name).h, 2.0 * small.h, 0.1 * small.h) << name;
        EXPECT_NEAR(bench->control(name).w, 2.0 * small.w, 0.2 * small.w) << name;
    }
    EXPECT_LT(bench->control("picture").w, before.w);
    // The mouse is where it is seen to be, and a pixel of the picture is one of the screen.
    bench->click("toolbar.one_to_one");
    EXPECT_EQ(bench->control("picture.image").w, 64.0);
    bench->hover("picture.image", pixel(20, 30));
    EXPECT_TRUE(bench->value("picture.value").starts_with("(20, 30)"));
    bench->drag("picture", 40, 0);
    EXPECT_TRUE(document().at("edits").contains("camera"));
    open("Scene");
    EXPECT_TRUE(bench->has("scene.play"));
}

// Nothing but a message: as many words as are needed to go on.
class WithoutAWindow : public testing::Test {
  protected:
    void expectMessage(const std::map<std::string, std::string>& environment,
                       const std::string& part) const {
        Conditions conditions;
        conditions.folder = folder / "";
        conditions.environment = environment;
        conditions.environment["XDG_CONFIG_HOME"] = (folder / "config").string();
        const Outcome outcome = runKaustik({"gui"}, conditions);
        EXPECT_EQ(outcome.exitCode, 1);
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(outcome.err.starts_with("kaustik: ")) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("'kaustik run'"), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    }
    TemporaryFolder folder;
};

TEST_F(WithoutAWindow, NoDisplayIsExplained) {
    expectMessage({{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}}, "no display");
}

TEST_F(WithoutAWindow, ADisplayThatDoesNotAnswerIsExplained) {
    expectMessage({{"DISPLAY", ":98765"}, {"WAYLAND_DISPLAY", ""}}, ":98765");
}

// A driver that offers an older version only.
TEST_F(WithoutAWindow, ADisplayWithoutOpenGL45IsExplained) {
    const Desktop desktop(640, 480);
    expectMessage({{"DISPLAY", desktop.name()}, {"MESA_GL_VERSION_OVERRIDE", "3.3"}}, "OpenGL 4.5");
}

TEST_F(WithoutAWindow, AnUnknownSceneIsAWrongRequest) {
    Conditions conditions;
    conditions.folder = folder / "";
    conditions.environment = {{"DISPLAY", ""}};
    const Outcome outcome = runKaustik({"gui", "pooool"}, conditions);
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_NE(outcome.err.find("pool"), std::string::npos);
}

}  // namespace
}  // namespace kaustik::test
