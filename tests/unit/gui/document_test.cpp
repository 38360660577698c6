// SPDX-License-Identifier: MIT
#include "framework/gui/document.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/gui/state.h"

namespace kaustik::gui::test {
namespace {

using nlohmann::json;

Document everything() {
    Document document;
    document.scene = "somewhere/ring.toml";
    document.size = {321, 123};
    document.variant.assignments = {{"trace", "march"}, {"trace.epsilon", "0.0123"}};
    document.variant.disabled = {"compose.direct"};
    document.other = Variant{"screen_space_photons", {{"trace", "lines"}}, {}};
    scene::Camera camera;
    camera.position = {1.0 / 3.0, 2.0, 3.0};
    document.edits.camera = camera;
    document.edits.timeSeconds = 0.1;
    document.edits.medium = scene::Medium{glm::vec3(0.1f), glm::vec3(0.2f), 0.3f};
    document.edits.lights["sun"] = {glm::dvec3(0.1, -1.0, 1.0 / 7.0), {}, 2.0f};
    document.edits.lights["lamp"] = {{}, glm::dvec3(1.0, 2.0, 1.0 / 3.0), {}};
    document.edits.waves["pond"] = {{0.1f, 0.3f, 10.0f, 0.5f, -1.0f}};
    return document;
}

TEST(Document, IsTheSameAfterARestart) {
    const std::string text = toJson(everything()).dump();
    std::vector<std::string> problems;
    EXPECT_EQ(documentFromJson(json::parse(text), problems), everything());
    EXPECT_EQ(documentFromJson(toJson(Document()), problems), Document());
    EXPECT_TRUE(problems.empty());
}

TEST(Document, ThatMakesNoSenseIsANewOne) {
    for (const char* text : {"null", "[]", "3", "{}", R"({"scene": 5})",
                             R"({"scene": "pool", "edits": {}, "size": [0, 600],
                                 "variant": {"technique": "x", "set": {}, "disable": []}})"}) {
        std::vector<std::string> problems;
        EXPECT_EQ(documentFromJson(json::parse(text), problems), Document()) << text;
        EXPECT_EQ(problems.size(), 1u) << text;
    }
    json broken = toJson(everything());
    broken["edits"]["waves"]["pond"][0] = "tall";
    std::vector<std::string> problems;
    EXPECT_EQ(documentFromJson(broken, problems), Document());
    EXPECT_EQ(problems.size(), 1u);
}

TEST(State, IsTheSameAfterARestart) {
    SavedState kept;
    kept.view.resource = "layers.depth";
    kept.view.layer = 3;
    kept.view.looks["hits.flux"] = {Channel::green,   false, -2.5f, true,
                                    Scale::symmetric, false, -1.0f, 3.0f};
    kept.view.comparedWith = ComparedImage::reference;
    kept.panels.leftWidth = 333.0f;
    kept.panels.recordFolder = "elsewhere";
    kept.window = {1000, 700, 10, 20};
    kept.isDeviceKnown = true;
    kept.panels.judgesReports = false;
    std::vector<std::string> problems;
    EXPECT_EQ(toJson(savedStateFromJson(toJson(kept), problems)), toJson(kept));
    EXPECT_TRUE(problems.empty());
    EXPECT_NE(toJson(kept), toJson(SavedState()));
}

TEST(State, ThatMakesNoSenseIsAsAtTheFirstStart) {
    for (const char* text : {"null", "[1]", R"({"view": 3, "panels": "x"})",
                             R"({"view": {"layer": "many", "split": null}})"}) {
        std::vector<std::string> problems;
        EXPECT_EQ(toJson(savedStateFromJson(json::parse(text), problems)), toJson(SavedState()))
            << text;
        EXPECT_FALSE(problems.empty()) << text;
    }
    std::vector<std::string> problems;
    const SavedState kept =
        savedStateFromJson(json::parse(R"({"window": {"width": -5, "height": 1e9},
                                                   "view": {"split": 7, "looks": {"a": {"channel": 99}}}})"),
                           problems);
    EXPECT_GE(kept.window.width, 400);
    EXPECT_LE(kept.window.height, 16384);
    EXPECT_EQ(kept.view.split, 1.0f);
    EXPECT_EQ(kept.view.lookOf("a").channel, Channel::luminance);
    EXPECT_EQ(kept.view.lookOf("b"), Look());
    // A smaller screen than the last time is no damage.
    EXPECT_TRUE(problems.empty());
}

}  // namespace
}  // namespace kaustik::gui::test
