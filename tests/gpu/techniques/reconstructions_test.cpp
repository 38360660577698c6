// SPDX-License-Identifier: MIT
// reconstruct.beams and reconstruct.triangles: all flux is kept, batches of photons are the same
// light as all at once, and none comes through what is opaque.
#include <algorithm>
#include <cmath>

#include "framework/numerics/cases/scene_text.h"
#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu/techniques/scene_parts.h"

namespace kaustik::test {
namespace {

using namespace numerics;
using glm::dvec3;

class Reconstructions : public ::testing::TestWithParam<const char*> {};

TEST_P(Reconstructions, KeepAllFlux) {
    for (const char* name :
         {"pool", "ring", "glass-sphere", "cornell-bunny", "glossy-table", "blocker"}) {
        SCOPED_TRACE(name);
        const scene::Scene scene = scene::loadScene(name);
        const Frame frame(scene, 160, 120,
                          {{"emit.photons", "48x48"}, {"reconstruct", GetParam()}});
        const EnergyLedger ledger = frame.renderer().ledger();
        EXPECT_GT(ledger.watts[transport::kAccountEmitted], 0.0);
        EXPECT_LE(std::abs(ledger.balance()), 1e-6);
        EXPECT_GT(frame.causticIrradiance().sum(), 0.0);
    }
}

// Photons all at once and in batches: the same light to the bit, and the same accounts.
void expectEqualInBatches(const scene::Scene& scene, const std::string& reconstruct,
                          const Settings& settings) {
    Settings whole = {{"emit.photons", "61x67"}, {"reconstruct", reconstruct}};
    whole.insert(whole.end(), settings.begin(), settings.end());
    Settings parts = whole;
    parts.emplace_back("emit.batch", "1000");
    const Frame a(scene, 160, 120, whole);
    const Frame b(scene, 160, 120, parts);
    EXPECT_GT(a.causticIrradiance().sum(), 0.0);
    EXPECT_EQ(a.causticIrradiance().values, b.causticIrradiance().values);
    EXPECT_EQ(a.renderer().ledger().watts, b.renderer().ledger().watts);
}

TEST_P(Reconstructions, OfBatchesAreThoseOfAllPhotonsAtOnce) {
    const scene::Scene scene = scene::loadScene("glass-sphere");
    expectEqualInBatches(scene, GetParam(), {{"specular", "interface"}});
}

// Cells that end at the border of the light, at creases and at the outline of the bunny.
TEST_P(Reconstructions, OfBatchesAreThoseOfAllAtOnceAtBordersToo) {
    expectEqualInBatches(scene::loadScene("pool"), GetParam(), {});
}

TEST_P(Reconstructions, OfBatchesThatFollowBothBranchesAreThoseOfAllAtOnce) {
    const Settings both = {
        {"specular", "split"}, {"specular.split.levels", "3"}, {"specular.bounces", "3"}};
    const scene::Scene scene = scene::loadScene("glass-sphere");
    expectEqualInBatches(scene, GetParam(), both);
}

TEST_P(Reconstructions, OfBatchesOfTwoLightsAreThoseOfAllAtOnce) {
    const scene::Scene scene =
        makeScene({{0.0, 2.0, 3.0}, {0.0, -0.5, 0.0}, 50.0, 0.01},
                  sun({0.2, -1.0, 0.1}) +
                      "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0.3, 1.5, 0.2]\n"
                      "intensity = 300\n" +
                      rippledWater() + floorPlane("floor", "grey", 8.0, {0, -1, 0}));
    expectEqualInBatches(scene, GetParam(), {{"specular", "interface"}});
}

INSTANTIATE_TEST_SUITE_P(By, Reconstructions, ::testing::Values("triangles", "beams"),
                         [](const ::testing::TestParamInfo<const char*>& tested) {
                             return std::string(tested.param);
                         });

// Water 2 m wide over a plate that hides the floor at x < 0; both of one material, and seen from
// below the plate.
class Plate : public ::testing::TestWithParam<double> {
  protected:
    static constexpr double kCell = 2.0 / 64.0;
    static constexpr double kPlate = -0.15;  // heights, m
    static constexpr double kFloor = -1.0;
};

TEST_P(Plate, HidesTheFloorFromTrianglesToWithinACell) {
    if (lacksExactTracer()) GTEST_SKIP() << "the build has no Embree";
    const double slope = GetParam();  // of the sun, x to y
    const scene::Scene scene = makeScene(
        {{-2.0, -0.25, 0.0}, {0.0, -1.0, 0.0}, 60.0, 0.01},
        sun({slope, -1.0, 0.0}) +
            object("water", "plane", "water", {0, 0, 0}, "size = [2, 2]\ncells = [4, 4]") +
            object("plate", "plane", "grey", {-1.0, kPlate, 0}, "size = [2, 3]") +
            floorPlane("floor", "grey", 8.0, {0, kFloor, 0}));
    const Frame frame(scene, 240, 180,
                      {{"emit.photons", "64x64"},
                       {"specular", "interface"},
                       {"trace", "raytraced"},
                       {"reconstruct", "triangles"}});
    const double sine = slope / std::hypot(slope, 1.0) / kWaterIndex;
    const double edge = sine / std::sqrt(1.0 - sine * sine) * (kPlate - kFloor);
    const double before = sine / std::sqrt(1.0 - sine * sine) * (0.0 - kFloor);
    const Texels receiver = frame.read("eye.receiver");
    const Texels irradiance = frame.causticIrradiance();
    int shadowed = 0;
    int lit = 0;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const double depth = double{receiver.at(x, y, 0)};
            if (depth <= 0.0) continue;
            const dvec3 world = frame.worldAt(x, y, depth);
            if (std::abs(world.y - kFloor) > 1e-3 || std::abs(world.z) > 0.9) continue;
            // A pixel is seen at its middle.
            const double pixel = 0.02;
            if (world.x < edge - kCell - pixel) {
                ++shadowed;
                EXPECT_EQ(irradiance.rgb(x, y), dvec3(0.0)) << world.x << " " << world.z;
            } else if (world.x > edge + kCell + pixel && world.x < 0.9 + before) {
                ++lit;
                EXPECT_GT(irradiance.rgb(x, y).g, 900.0 * (slope == 0.0 ? 1.0 : 0.9))
                    << world.x << " " << world.z;
            }
        }
    }
    EXPECT_GT(shadowed, 2000);
    EXPECT_GT(lit, 500);
}

INSTANTIATE_TEST_SUITE_P(UnderASun, Plate, ::testing::Values(0.0, 0.4));

}  // namespace
}  // namespace kaustik::test
