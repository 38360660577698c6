// SPDX-License-Identifier: MIT
// driver.dense, refined, where light is stored in a light's map: finer photons next to coarser ones
// keep the flux, and even light even (on the screen: hard case D48).
#include <algorithm>
#include <cmath>

#include "framework/numerics/cases/scene_text.h"
#include "framework/pipeline/ledger.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using numerics::floorPlane;
using numerics::object;

constexpr double kIrradiance = 1000.0;
constexpr double kSheetSide = 5.0;
constexpr int kPhotons = 32;
constexpr double kCell = kSheetSide / kPhotons;
constexpr int kSize = 192;
constexpr double kBlockSide = 0.9;
const glm::dvec3 kBlock{1.2, 0.15, 0.13};

// Light straight down through a sheet that bends nothing, on a floor with a block on it, seen from
// above.
scene::Scene belowASheet() {
    numerics::CameraText camera;
    camera.position = {0.0, 6.0, 1.0};
    camera.target = {0.0, 0.0, 0.0};
    scene::Scene scene =
        numerics::makeScene(camera, numerics::sun({0.0, -1.0, 0.0}, kIrradiance) +
                                        floorPlane("floor", "grey", 8, {0, 0, 0}) +
                                        floorPlane("air", "water", kSheetSide, {0, 1, 0}) +
                                        object("block", "box", "white", kBlock,
                                               fmt::format("size = [{0}, 0.3, {0}]", kBlockSide)));
    scene.materials[numerics::kWater - 1].ior = 1.0f;
    return scene;
}

double fromBlock(const glm::dvec3& at) {
    const double x = std::abs(at.x - kBlock.x) - 0.5 * kBlockSide;
    const double z = std::abs(at.z - kBlock.z) - 0.5 * kBlockSide;
    return x <= 0.0 && z <= 0.0 ? std::min(-x, -z) : std::hypot(std::max(x, 0.0), std::max(z, 0.0));
}

class DenseRefined : public testing::TestWithParam<int> {};

TEST_P(DenseRefined, KeepsFluxAndEvenLightInALightsMap) {
    const int parts = GetParam();
    const scene::Scene scene = belowASheet();
    const Frame frame(scene, kSize, kSize,
                      {{"emit.photons", "32x32"},
                       {"driver.dense.refine", std::to_string(parts)},
                       {"reconstruct.space", "light"},
                       {"gather", "project"}},
                      {"eye.receiver"}, true, "exact_rays");
    const EnergyLedger ledger = frame.renderer().ledger();
    // A block's outline has finer photons, and nothing else: no more than all of the grid's.
    const std::uint64_t photons = ledger.events[transport::kAccountEmitted];
    constexpr std::uint64_t kGrid = kPhotons * kPhotons;
    if (parts == 1) {
        EXPECT_LE(photons, kGrid);
    } else {
        EXPECT_GT(photons, kGrid);
        EXPECT_LT(photons, kGrid * static_cast<std::uint64_t>(parts * parts));
    }
    const double emitted = ledger.watts[transport::kAccountEmitted];
    const double all = kIrradiance * kSheetSide * kSheetSide;
    EXPECT_NEAR(emitted, all, 1e-6 * all);
    EXPECT_NEAR(ledger.watts[transport::kAccountArrived], emitted, 1e-6 * emitted);
    EXPECT_NEAR(ledger.balance(), 0.0, 1e-5);
    // What the block's sides are next to is seen edge-on by the light, and has no texels.
    EXPECT_GT(ledger.watts[transport::kAccountDeposited], 0.99 * emitted);
    const Texels irradiance = frame.causticIrradiance();
    const Texels receiver = frame.read("eye.receiver");
    double worst = 0.0;
    int pixels = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const glm::dvec3 at = frame.worldAt(x, y, static_cast<double>(receiver.at(x, y, 0)));
            const bool isLevel = std::abs(at.y) < 1e-3 || std::abs(at.y - 0.3) < 1e-3;
            if (!isLevel || std::max(std::abs(at.x), std::abs(at.z)) > 2.2) continue;
            if (fromBlock(at) < 1.5 * kCell / parts + 0.1) continue;
            ++pixels;
            worst = std::max(worst, std::abs(irradiance.rgb(x, y).g / kIrradiance - 1.0));
        }
    }
    EXPECT_GT(pixels, 5000);
    EXPECT_LT(worst, 0.01);
}

INSTANTIATE_TEST_SUITE_P(InMaps, DenseRefined, testing::Values(1, 3, 5));

}  // namespace
}  // namespace kaustik::test
