// SPDX-License-Identifier: MIT
// What nodes say of the caps that they have kept to: each photon counts once, in whichever batch or
// round of a loop it was.
#include <algorithm>
#include <optional>

#include "framework/numerics/cases/scene_text.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using namespace numerics;

const CameraText kCamera{{0.0, 2.5, 3.0}, {0.0, 0.0, 0.0}};
const std::string kFloor = floorPlane("floor", "grey", 8.0, {0, 0, 0});
const std::string kBall =
    object("ball", "sphere", "glass", {0, 1.0, 0}, "radius = 0.4\nsegments = 48");
const std::string kFog = "[medium]\nscattering_per_meter = 0.2\nabsorption_per_meter = 0.05\n";

struct Case {
    std::string name;
    std::string technique;
    Settings settings;
    std::string limit;
    // Values of this setting give the same frame.
    std::string varied;
    std::vector<std::string> values;
};

void PrintTo(const Case& tested, std::ostream* out) {
    *out << tested.name;
}

std::optional<ReachedLimit> limitOf(const Frame& frame, const std::string& parameter) {
    const std::vector<ReachedLimit> limits = frame.renderer().reachedLimits();
    const auto found = std::find_if(limits.begin(), limits.end(), [&](const ReachedLimit& limit) {
        return limit.parameter == parameter;
    });
    return found == limits.end() ? std::nullopt : std::optional(*found);
}

class CountedLimits : public testing::TestWithParam<Case> {};

TEST_P(CountedLimits, AreTheSameHoweverThePhotonsAreParted) {
    const Case& tested = GetParam();
    const std::string medium = tested.limit.starts_with("media") ? kFog : "";
    const scene::Scene scene = makeScene(kCamera, sun({0.1, -1, 0}) + kFloor + kBall + medium);
    std::optional<ReachedLimit> first;
    for (const std::string& value : tested.values) {
        SCOPED_TRACE(tested.varied + " = " + value);
        Settings settings = tested.settings;
        settings.emplace_back("emit.photons", "32x32");
        settings.emplace_back("reconstruct.map_size", "128");
        settings.emplace_back(tested.varied, value);
        const Frame frame(scene, 96, 72, settings, {}, false, tested.technique);
        const std::optional<ReachedLimit> limit = limitOf(frame, tested.limit);
        ASSERT_TRUE(limit);
        EXPECT_GT(limit->count, 0u);
        if (!first) first = limit;
        EXPECT_EQ(limit->count, first->count);
        EXPECT_EQ(limit->needed, first->needed);
        // What four photons share out at the border of a batch is split between two.
        EXPECT_NEAR(limit->countedWatts, first->countedWatts, 0.01 * first->countedWatts);
    }
}

const std::vector<std::string> kBatches = {"4194304", "256", "100"};

INSTANTIATE_TEST_SUITE_P(
    , CountedLimits,
    testing::Values(Case{"Slots",
                         "screen_space_photons",
                         {{"trace", "all_hits"}, {"trace.all_hits.slots", "1"}},
                         "trace.all_hits.slots",
                         "emit.batch",
                         kBatches},
                    Case{"Triangles",
                         "screen_space_photons",
                         {{"reconstruct", "triangles"}, {"reconstruct.triangles.maximum", "2"}},
                         "reconstruct.triangles.maximum",
                         "emit.batch",
                         kBatches},
                    Case{"Sprites",
                         "screen_space_photons",
                         {{"reconstruct", "sprites"}, {"reconstruct.sprites.maximum", "1"}},
                         "reconstruct.sprites.maximum",
                         "emit.batch",
                         kBatches},
                    Case{"Reach",
                         "screen_space_photons",
                         {{"reconstruct", "sprites"},
                          {"reconstruct.sprites.radius", "0.5"},
                          {"reconstruct.sprites.reach", "4"}},
                         "reconstruct.sprites.reach",
                         "emit.batch",
                         kBatches},
                    Case{"Lens",
                         "lens_splats",
                         {{"reconstruct.lens.min_diameter", "9"}},
                         "reconstruct.lens.min_diameter",
                         "emit.batch",
                         kBatches},
                    Case{"Lines",
                         "screen_space_photons",
                         {{"media", "lines"}, {"media.lines.maximum", "1"}},
                         "media.lines.maximum",
                         "emit.batch",
                         kBatches},
                    Case{"LooksAtACube",
                         "caustic_triangles",
                         {{"gather.cube.max_samples", "1"}},
                         "gather.cube.max_samples",
                         "emit.batch",
                         kBatches},
                    Case{"RoundsOfALoop",
                         "adaptive_caustic_map",
                         {{"refine.metric", "traversal"},
                          {"refine.finest", "128"},
                          {"refine.start", "16"},
                          {"reconstruct", "sprites"},
                          {"filter", "none"},
                          {"reconstruct.sprites.radius", "4"},
                          {"reconstruct.sprites.maximum", "1"}},
                         "reconstruct.sprites.maximum",
                         "refine.memory",
                         {"64", "1"}}),
    [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

// A photon is one splat, however often its texels are looked at.
TEST(CountedSplats, AreCountedOnce) {
    const scene::Scene scene = makeScene(kCamera, sun({0.1, -1, 0}) + kFloor + kBall);
    const Frame frame(scene, 96, 72,
                      {{"emit.photons", "32x32"},
                       {"reconstruct.map_size", "128"},
                       {"reconstruct.lens.min_diameter", "60"}},
                      {}, false, "lens_splats");
    const std::optional<ReachedLimit> limit = limitOf(frame, "reconstruct.lens.min_diameter");
    ASSERT_TRUE(limit);
    const EnergyLedger ledger = frame.renderer().ledger();
    // A splat of which a part alone is lost is in an account, too.
    EXPECT_GE(limit->count, ledger.events[transport::kAccountArrived] -
                                ledger.events[transport::kAccountOutsideMap] -
                                ledger.events[transport::kAccountHiddenInMap]);
    EXPECT_LE(limit->count, ledger.events[transport::kAccountArrived]);
    EXPECT_LT(limit->needed, limit->value);
}

}  // namespace
}  // namespace kaustik::test
