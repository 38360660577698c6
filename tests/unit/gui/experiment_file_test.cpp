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
    [[nodiscard]] static ExperimentTerms precise() {
        ExperimentTerms terms;
        terms.isPrecise = true;
        return terms;
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
    const auto files = writeExperiment(document, registry_, folder_ / "out", "mine", precise());
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
        plan(writeExperiment(document, registry_, folder_ / "out", "two", {}).front());
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
    const auto files = writeExperiment(document, registry_, folder_ / "out", "changed", {});
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(plan(files.front()).runs.front().settings["time_s"], 1.0 / 7.0);
    const scene::Scene loaded = scene::loadScene(files[1].string());
    EXPECT_EQ(loaded.camera, *document.edits.camera);

    // A change of a change: the file of the first is the scene of the second.
    Document next;
    next.scene = files[1].string();
    next.edits.timeSeconds = 2.0;
    const auto second = writeExperiment(next, registry_, folder_ / "elsewhere", "again", {});
    const scene::Scene again = scene::loadScene(second[1].string());
    EXPECT_EQ(again.camera, *document.edits.camera);
    EXPECT_EQ(again.timeSeconds, 2.0);
    EXPECT_EQ(plan(second.front()).runs.size(), 1u);
}

// So that errors come back too.
TEST_F(ExperimentFile, TakesTheReferenceAlong) {
    Document document;
    document.scene = "ring";
    ExperimentTerms terms;
    const auto without = writeExperiment(document, registry_, folder_ / "out", "without", terms);
    EXPECT_EQ(plan(without.front()).runs.front().settings["reference"], "none");
    terms.referencePhotons = 123456789012;
    const auto with = writeExperiment(document, registry_, folder_ / "out", "with", terms);
    const nlohmann::json settings = plan(with.front()).runs.front().settings;
    EXPECT_EQ(settings["reference"], "auto");
    EXPECT_EQ(settings["reference_photons"], 123456789012);
}

TEST_F(ExperimentFile, OfAStudyHasARunForEachCombinationInItsOrder) {
    Study study;
    study.document.scene = "ring";
    study.document.size = {64, 48};
    study.document.variant.assignments = {{"layers.count", "4"}, {"emit.photons", "32x16"}};
    study.document.edits.timeSeconds = 0.25;
    study.axes = {{kTechniqueKey, {"exact_rays", "screen_space_photons"}},
                  {"layers.count", {"2", "6", "1"}},
                  {"trace.epsilon", {"0.01"}},
                  {"shadow", {"map", "bvh"}}};
    ExperimentTerms terms;
    terms.frames = 3;
    const auto files = writeStudy(study, registry_, folder_ / "out", "many", terms);
    ASSERT_EQ(files.size(), 2u) << "the changed scene comes with it";
    const experiment::Plan found = plan(files.front());
    const std::vector<Variant> variants = variantsOf(study);
    ASSERT_EQ(found.runs.size(), variants.size());
    ASSERT_EQ(variants.size(), 12u);
    for (std::size_t i = 0; i < variants.size(); ++i) {
        const nlohmann::json& settings = found.runs[i].settings;
        const RenderSettings expected = settingsOf(variants[i], study.document.size, registry_);
        EXPECT_EQ(settings["technique"], variants[i].technique) << i;
        EXPECT_EQ(settings["parameters"], expected.params.json()) << i;
        EXPECT_EQ(settings["frames"], 3);
        EXPECT_EQ(settings["time_s"], 0.25);
        EXPECT_EQ(found.runs[i].axes.size(), 4u);
    }
}

TEST_F(ExperimentFile, RefusesNamesThatAreNone) {
    for (const char* name : {"", "a b", "../x", "ä"}) {
        EXPECT_THROW(writeExperiment({}, registry_, folder_ / "out", name, {}), ConfigError)
            << name;
    }
}

}  // namespace
}  // namespace kaustik::gui::test
