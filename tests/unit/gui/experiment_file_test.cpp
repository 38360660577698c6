// SPDX-License-Identifier: MIT
#include "framework/gui/experiment_file.h"

#include <gtest/gtest.h>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/experiment/plan.h"
#include "framework/scene/files/scene_file.h"
#include "techniques/register_all.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::gui::test {
namespace {

class ExperimentFile : public testing::Test {
  protected:
    [[nodiscard]] experiment::Plan plan(const std::filesystem::path& file) const {
        const experiment::RunDefaults defaults{
            "pool", "screen_space_photons", "800x600", 8, 1, 1, "none", 1000};
        return makePlan(
            experiment::readSpec(file), defaults,
            [this](const std::string& technique, bool isAsPublished) {
                return registry_.makeParams(registry_.findTechnique(technique, isAsPublished));
            });
    }
    kaustik::test::TemporaryFolder folder_;
    Registry registry_ = registerAll();
};

TEST_F(ExperimentFile, HasEveryChoiceOfTheDocument) {
    Document document;
    document.scene = "ring";
    document.size = {64, 48};
    document.variant.assignments = {
        {"trace", "march"}, {"trace.epsilon", "0.0123"}, {"emit.photons", "32x16"}};
    document.variant.disabled = {"compose.direct"};
    const auto files = writeExperiment(document, registry_, folder_ / "out", "mine", true);
    ASSERT_EQ(files.size(), 1u);
    const experiment::Plan found = plan(files.front());
    ASSERT_EQ(found.runs.size(), 1u);
    const nlohmann::json& settings = found.runs.front().settings;
    EXPECT_EQ(settings["scene"]["name"], "ring");
    EXPECT_EQ(settings["size"], "64x48");
    EXPECT_EQ(settings["precise"], true);
    EXPECT_EQ(settings["parameters"]["trace"], "march");
    EXPECT_EQ(settings["parameters"]["trace.epsilon"], 0.0123);
    EXPECT_EQ(settings["parameters"]["emit.photons"], "32x16");
    EXPECT_EQ(settings["disable"], nlohmann::json::array({"compose.direct"}));
}

TEST_F(ExperimentFile, HasARunForEachOfTwoVariants) {
    Document document;
    document.scene = "ring";
    document.variant.assignments = {{"trace", "march"}};
    document.other = Variant{"screen_space_photons", {{"layers.count", "4"}}, {}};
    const experiment::Plan found =
        plan(writeExperiment(document, registry_, folder_ / "out", "two", false).front());
    ASSERT_EQ(found.runs.size(), 2u);
    EXPECT_EQ(found.runs[0].settings["parameters"]["trace"], "march");
    EXPECT_EQ(found.runs[0].settings["parameters"]["layers.count"], 8);
    EXPECT_EQ(found.runs[1].settings["parameters"]["trace"], "hierarchical");
    EXPECT_EQ(found.runs[1].settings["parameters"]["layers.count"], 4);
}

TEST_F(ExperimentFile, ComesWithTheSceneAsItWasChanged) {
    Document document;
    document.scene = "ring";
    document.edits.camera = scene::loadScene("ring").camera;
    document.edits.camera->position.x += 1.0 / 3.0;
    document.edits.timeSeconds = 1.0 / 7.0;
    const auto files = writeExperiment(document, registry_, folder_ / "out", "changed", false);
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(plan(files.front()).runs.front().settings["time_s"], 1.0 / 7.0);
    const scene::Scene loaded = scene::loadScene(files[1].string());
    EXPECT_EQ(loaded.camera, *document.edits.camera);

    // A change of a change: the file of the first is the scene of the second.
    Document next;
    next.scene = files[1].string();
    next.edits.timeSeconds = 2.0;
    const auto second = writeExperiment(next, registry_, folder_ / "elsewhere", "again", false);
    const scene::Scene again = scene::loadScene(second[1].string());
    EXPECT_EQ(again.camera, *document.edits.camera);
    EXPECT_EQ(again.timeSeconds, 2.0);
    EXPECT_EQ(plan(second.front()).runs.size(), 1u);
}

TEST_F(ExperimentFile, RefusesNamesThatAreNone) {
    for (const char* name : {"", "a b", "../x", "ä"}) {
        EXPECT_THROW(writeExperiment({}, registry_, folder_ / "out", name, false), ConfigError)
            << name;
    }
}

}  // namespace
}  // namespace kaustik::gui::test
