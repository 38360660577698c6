// SPDX-License-Identifier: MIT
// The panel Scene and the hand on the picture: camera, lights, time, water, another scene.
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <regex>
#include <set>

#include "framework/core/files.h"
#include "tests/gui/workbench_fixture.h"
#include "tests/unit/importers/gltf_file_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class ScenePanel : public WorkbenchTest {
  protected:
    [[nodiscard]] json edits() { return document().at("edits"); }
    [[nodiscard]] static glm::dvec3 vectorIn(const json& list) {
        return {list.at(0), list.at(1), list.at(2)};
    }
    [[nodiscard]] glm::dvec3 position() { return vectorIn(edits().at("camera").at("position")); }
    [[nodiscard]] glm::dvec3 target() { return vectorIn(edits().at("camera").at("target")); }
    static json withLightHandles(const std::string& scene) {
        json kept = savedStateWith(smallDocument(scene));
        kept["view"]["shows_lights"] = true;
        return kept;
    }
};

// That the scene's file says.
const glm::dvec3 kPosition(0.0, 2.0, 1.0);
const glm::dvec3 kTarget(0.0);

// A keyboard may print a comma where a number's point is meant; what is left out would make another
// number of it.
TEST_F(ScenePanel, ACommaIsANumbersPointAndWhatIsTypedIsNeverInfinite) {
    start();
    open("Scene");
    bench->typeInto("scene.camera", "0,05", Entry::controlClick, "Return", {0.05, 0.5});
    EXPECT_NEAR(position().x, 0.05, 1e-6);
    for (const char* text : {"1e400", "-1e400", "99999999999999999999"}) {
        bench->typeInto("scene.camera", text, Entry::controlClick, "Return", {0.05, 0.5});
        EXPECT_LE(std::abs(position().x), 1e6) << text;
        EXPECT_TRUE(std::isfinite(position().x)) << text;
    }
    bench->typeInto("scene.time", "2,5", Entry::controlClick, "Return", {0.3, 0.5});
    EXPECT_NEAR(edits().at("time").get<double>(), 2.5, 1e-6);
    // In a text it stays what it is.
    bench->typeInto("parameters.search", "0,05");
    EXPECT_EQ(bench->value("parameters.search"), "0,05");
}

TEST_F(ScenePanel, APastedDecimalCommaIsAPoint) {
    start();
    open("Scene");
    bench->typeInto("parameters.search", "0,75", Entry::click, "ctrl+a");
    bench->key("ctrl+c");
    bench->typeInto("scene.camera", "", Entry::controlClick, "ctrl+v", {0.05, 0.5});
    bench->key("Return");
    EXPECT_NEAR(position().x, 0.75, 1e-6);
    bench->typeInto("parameters.search", "", Entry::click, "ctrl+v");
    EXPECT_EQ(bench->value("parameters.search"), "0,75");
}

TEST_F(ScenePanel, ADragOrbitsAboutTheTargetAndRComesBack) {
    start();
    const Image before = seenPicture();
    bench->drag("picture", 120, 40);
    untilSettled();
    // As far from the target as before, and round by half a turn over the picture's height.
    EXPECT_NEAR(glm::length(position() - target()), glm::length(kPosition), 1e-9);
    EXPECT_NEAR(glm::length(target() - kTarget), 0.0, 1e-9);
    const double pixels = bench->control("picture.image").h;
    EXPECT_NEAR(std::atan2(-position().x, position().z), std::acos(-1.0) * 120.0 / pixels, 0.02);
    EXPECT_GT(position().y, kPosition.y) << "down with the hand is up with the camera";
    EXPECT_GT(largestDifference(seenPicture(), before), 0.2);
    EXPECT_EQ(bench->status().at("preview"), false);
    bench->keepScreenshot("scene-orbit");
    bench->key("r");
    untilSettled();
    EXPECT_FALSE(edits().contains("camera"));
    EXPECT_EQ(largestDifference(seenPicture(), before), 0.0);
}

TEST_F(ScenePanel, APressThatTremblesIsAClick) {
    json kept = withLightHandles("wavy.toml");
    start(kept);
    open("Image");
    const json before = document();
    bench->drag("picture", 1, 0);
    bench->drag("picture", -2, 2);
    bench->drag("picture", 1, 1, kRightButton);
    bench->drag("light.sun", 1, 0);
    EXPECT_EQ(document(), before) << "the view, and the reference of it, stay";
    EXPECT_EQ(bench->value("shown"), "asked");
    // What a click does it does all the same.
    bench->click("image.probe");
    bench->drag("picture.image", 1, 0, kLeftButton, pixel(10, 40));
    bench->waitFor("photons", [](const json& screen) {
        return screen.at("controls").contains("image.probe_landed");
    });
    EXPECT_EQ(document(), before);
    // A drag counts from where it began.
    bench->drag("picture", 60, 0);
    const double pixels = bench->control("picture.image").h;
    EXPECT_NEAR(std::atan2(-position().x, position().z), std::acos(-1.0) * 60.0 / pixels, 0.02);
}

TEST_F(ScenePanel, ARightDragLooksAroundFromTheSamePlace) {
    start();
    bench->drag("picture", 60, 0, kRightButton);
    EXPECT_NEAR(glm::length(position() - kPosition), 0.0, 1e-9);
    EXPECT_GT(glm::length(target() - kTarget), 0.1);
    EXPECT_NEAR(glm::length(target() - position()), glm::length(kPosition), 1e-9);
}

TEST_F(ScenePanel, CtrlAndTheWheelComeNearer) {
    start();
    bench->keyDown("ctrl");
    bench->wheel("picture", 2);
    bench->keyUp("ctrl");
    const glm::dvec3 nearer = position();
    EXPECT_NEAR(glm::length(glm::cross(nearer, kPosition)), 0.0, 1e-9) << "straight on";
    EXPECT_LT(glm::length(nearer), 0.9 * glm::length(kPosition));
    bench->keyDown("ctrl");
    bench->wheel("picture", -2);
    bench->keyUp("ctrl");
    EXPECT_NEAR(glm::length(position() - kPosition), 0.0, 1e-9);
}

TEST_F(ScenePanel, KeysFly) {
    // Frames that take a while: what is on the screen is older than what the keys have done.
    Json slow = smallDocument();
    slow["size"] = {320, 240};
    slow["variant"]["set"]["emit.photons"] = "256x256";
    start(savedStateWith(slow));
    bench->hover("picture");
    bench->key("w");
    const glm::dvec3 forward = position() - kPosition;
    const glm::dvec3 way = glm::normalize(kTarget - kPosition);
    EXPECT_GT(glm::length(forward), 0.0);
    EXPECT_NEAR(glm::dot(glm::normalize(forward), way), 1.0, 1e-9);
    EXPECT_NEAR(glm::length((target() - kTarget) - forward), 0.0, 1e-9);
    bench->key("r");
    bench->key("d");
    EXPECT_GT(position().x, 0.0);
    EXPECT_NEAR(position().y, kPosition.y, 1e-9);
}

TEST_F(ScenePanel, TheHandleOfALightMovesTheLight) {
    start(withLightHandles("wavy.toml"));
    open("Scene");
    bench->keepScreenshot("scene");
    // The sun's own, which the scene's file gives: 6 degrees from straight down.
    const glm::dvec3 own = glm::normalize(glm::dvec3(0.1, -1.0, 0.0));
    bench->drag("light.sun", -60, 0);
    untilSettled();
    const glm::dvec3 moved = vectorIn(edits().at("lights").at("sun").at("direction"));
    EXPECT_NEAR(glm::length(moved), 1.0, 1e-6);
    // The handle, whence the light comes, went left: the light goes right.
    EXPECT_GT(moved.x, own.x + 0.05);
    EXPECT_FALSE(edits().contains("camera"));
    bench->keepScreenshot("scene-light");
    bench->click("reset.light.sun");
    EXPECT_FALSE(edits().contains("lights"));
}

// Points to it from the edge of the picture, and moves with the view.
TEST_F(ScenePanel, ALightThatIsOffTheScreenIsMarkedWhereItLies) {
    start(withLightHandles("glass-sphere"));
    const auto middleOf = [](const Rectangle& r) {
        return glm::dvec2(r.x + 0.5 * r.w, r.y + 0.5 * r.h);
    };
    const Rectangle area = bench->control("picture");
    // The right button looks elsewhere, round and down.
    std::vector<glm::dvec2> places;
    std::set<std::string> kinds;
    for (int step = 0; step < 14; ++step) {
        bench->drag("picture", 150, 6, kRightButton, {0.3, 0.9});
        if (!bench->has("light.lamp")) continue;
        kinds.insert(bench->value("light.lamp"));
        if (bench->value("light.lamp") == "seen") continue;
        const glm::dvec2 place = middleOf(bench->control("light.lamp"));
        const double edge = std::min({place.x - area.x, area.x + area.w - place.x, place.y - area.y,
                                      area.y + area.h - place.y});
        EXPECT_GT(edge, 0.0);
        EXPECT_LT(edge, 40.0) << "at the edge";
        places.push_back(place);
        if (places.size() == 2) bench->keepScreenshot("scene-light-outside");
    }
    EXPECT_TRUE(kinds.contains("outside"));
    EXPECT_TRUE(kinds.contains("behind"));
    ASSERT_GT(places.size(), 4u);
    std::size_t moves = 0;
    for (std::size_t i = 1; i < places.size(); ++i)
        moves += glm::distance(places[i], places[i - 1]) > 1.0 ? 1 : 0;
    EXPECT_GE(moves, places.size() - 2) << "it is not stuck in a corner";
}

TEST_F(ScenePanel, HandlesAreShownAndHiddenWithL) {
    start(withLightHandles("glass-sphere"));
    ASSERT_TRUE(bench->has("light.lamp"));
    bench->key("l");
    EXPECT_FALSE(bench->has("light.lamp"));
    bench->key("l");
    bench->drag("light.lamp", 50, 30);
    EXPECT_TRUE(edits().at("lights").at("lamp").contains("position"));
}

TEST_F(ScenePanel, ALightCanBeMadeBrighter) {
    json small = smallDocument();
    small["variant"]["set"]["compose.picture.exposure"] = "0.002";  // else it follows the light
    start(savedStateWith(small));
    open("Scene");
    const Image before = seenPicture();
    bench->typeInto("scene.power.sun", "3", Entry::controlClick, "Return", {0.2, 0.5});
    untilSettled();
    EXPECT_EQ(edits().at("lights").at("sun").at("power_factor"), 3.0);
    EXPECT_GT(meanOf(seenPicture()), meanOf(before) + 0.02);
}

TEST_F(ScenePanel, TimeGoesOnByStepsWhileItPlays) {
    json kept = savedStateWith(smallDocument());
    kept["panels"]["sequence_step"] = 0.25;
    start(kept);
    const Image before = seenPicture();
    open("Scene");
    bench->click("scene.step");
    untilSettled();
    EXPECT_NEAR(bench->status().at("time_s").get<double>(), 0.25, 1e-6);
    EXPECT_NEAR(edits().at("time").get<double>(), 0.25, 1e-6);
    EXPECT_GT(largestDifference(seenPicture(), before), 0.02) << "the wave has moved";
    bench->key(".");
    EXPECT_NEAR(edits().at("time").get<double>(), 0.5, 1e-6);

    bench->click("scene.play");
    bench->waitFor("time that goes on", [](const json& screen) {
        return screen.at("status").at("time_s").get<double>() > 2.0;
    });
    EXPECT_EQ(bench->status().at("playing"), true);
    bench->keepScreenshot("scene-playing");
    bench->click("scene.play");
    EXPECT_EQ(bench->status().at("playing"), false);
    untilSettled();
    const double stopped = edits().at("time");
    EXPECT_NEAR(std::fmod(stopped + 1e-3, 0.25), 0.0, 2e-3) << "by whole steps";
    bench->untilTaken();
    EXPECT_EQ(edits().at("time"), stopped);
}

TEST_F(ScenePanel, SpacePlaysAndPauses) {
    start();
    bench->hover("picture");
    bench->key("space");
    EXPECT_EQ(bench->status().at("playing"), true);
    bench->key("space");
    EXPECT_EQ(bench->status().at("playing"), false);
}

TEST_F(ScenePanel, WavesCanBeMadeHigher) {
    start();
    const Image before = seenPicture();
    open("Scene");
    bench->click("scene.header.water");
    bench->typeInto("scene.wave.water.0.amplitude", "0.08", Entry::controlClick, "Return",
                    {0.2, 0.5});
    untilSettled();
    EXPECT_NEAR(edits().at("waves").at("water").at(0).at(0).get<double>(), 0.08, 1e-6);
    bench->keepScreenshot("scene-water");
    EXPECT_GT(largestDifference(seenPicture(), before), 0.05);
    bench->click("reset.water.water");
    untilSettled();
    EXPECT_EQ(largestDifference(seenPicture(), before), 0.0);
}

TEST_F(ScenePanel, AnotherSceneIsChosenAndBeginsWithoutTheChangesOfThisOne) {
    start();
    bench->drag("picture", 50, 0);
    open("Scene");
    choose("scene.choice", "ring");
    untilSettled();
    EXPECT_EQ(bench->status().at("scene"), "ring");
    EXPECT_EQ(bench->status().at("rendered_scene"), "ring");
    EXPECT_TRUE(edits().empty());
    EXPECT_EQ(document().at("variant").at("set").at("emit.photons"), "32x32");
    bench->keepScreenshot("scene-ring");
}

TEST_F(ScenePanel, ThePicturesSizeIsTyped) {
    start();
    open("Scene");
    bench->typeInto("scene.size", "32", Entry::click, "Return", {0.1, 0.5});
    untilSettled();
    EXPECT_EQ(document().at("size"), json({32, 48}));
    bench->typeInto("scene.size", "0", Entry::click, "Return", {0.5, 0.5});
    untilSettled();
    EXPECT_EQ(document().at("size"), json({32, 1}));
    EXPECT_EQ(bench->status().at("problem"), "");
    const Rectangle image = bench->control("picture.image");
    EXPECT_NEAR(image.w / image.h, 32.0, 0.1);
}

TEST_F(ScenePanel, AFileThatIsDroppedIsTheScene) {
    start();
    const std::string other =
        std::regex_replace(readFile(folder / "wavy.toml"), std::regex("wavy"), "other water");
    bench->dropFiles({folder.file("other.toml", other)}, "picture");
    untilSettled();
    EXPECT_EQ(bench->status().at("rendered_scene"), "other water");
    EXPECT_EQ(bench->status().at("scene"), (folder / "other.toml").string());

    json tetrahedron = scene::test::tetrahedronScene();  // of glass, through which nothing is seen
    tetrahedron["materials"][0] = {{"name", "chalk"}};
    const std::string bytes = scene::test::glb(tetrahedron, scene::test::tetrahedronBytes());
    bench->dropFiles({folder.file("tetra.glb", bytes)}, "picture");
    untilSettled();
    EXPECT_EQ(bench->status().at("rendered_scene"), "tetra");
    EXPECT_EQ(bench->status().at("problem"), "");
    bench->keepScreenshot("scene-dropped");
    const Image dropped = seenPicture();
    EXPECT_GT(*std::max_element(dropped.values.begin(), dropped.values.end()), 0.2f);
}

TEST_F(ScenePanel, ADroppedMeshStandsOnATable) {
    start();
    const std::string mesh =
        "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4";
    bench->dropFiles({folder.file("thing.obj", mesh)}, "picture");
    untilSettled();
    EXPECT_EQ(bench->status().at("rendered_scene"), "thing-on-table");
    EXPECT_TRUE(says("status.message", "thing.obj, which stands on a table"));

    json lampless = scene::test::tetrahedronScene();
    lampless["nodes"] = json::array({lampless["nodes"][0]});
    lampless["scenes"][0]["nodes"] = {0};
    const std::string bytes = scene::test::glb(lampless, scene::test::tetrahedronBytes());
    bench->dropFiles({folder.file("tetra.glb", bytes)}, "picture");
    untilSettled();
    EXPECT_EQ(bench->status().at("rendered_scene"), "tetra-on-table");
    EXPECT_EQ(bench->status().at("problem"), "");
    const Image seen = seenPicture();
    EXPECT_GT(*std::max_element(seen.values.begin(), seen.values.end()), 0.2f);
}

TEST_F(ScenePanel, AFileThatIsNoSceneIsRefusedAndAllStays) {
    start();
    const json before = document();
    bench->dropFiles({folder.file("notes.txt", "x")}, "picture");
    EXPECT_TRUE(says("status.message", (folder / "notes.txt").string() + "' is neither a scene"));
    EXPECT_EQ(document(), before);
}

TEST_F(ScenePanel, ASceneWithAnErrorIsExplainedAndTheRestStaysInUse) {
    start();
    const Image before = seenPicture();
    const std::string bad = std::regex_replace(readFile(folder / "wavy.toml"),
                                               std::regex("albedo = 0.5"), "albedo = 7.5");
    bench->dropFiles({folder.file("bad.toml", bad)}, "picture");
    bench->waitFor("the problem", [](const json& screen) {
        return screen.at("controls").contains("status.problem");
    });
    EXPECT_TRUE(says("status.problem", "bad.toml"));
    EXPECT_TRUE(says("status.problem", "albedo"));
    EXPECT_EQ(largestDifference(seenPicture(), before), 0.0);
    bench->keepScreenshot("scene-error");
    // Mended, and read again.
    static_cast<void>(folder.file("bad.toml", readFile(folder / "wavy.toml")));
    bench->key("F5");
    untilSettled();
    EXPECT_FALSE(bench->has("status.problem"));
    EXPECT_EQ(bench->status().at("rendered_scene"), "wavy");
}

}  // namespace
}  // namespace kaustik::test
