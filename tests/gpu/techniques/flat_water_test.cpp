// SPDX-License-Identifier: MIT
// Still water under a sun that stands straight above. Every ray goes straight down, so the floor's
// caustic irradiance is (1 - ((n-1)/(n+1))²) times the sun's, everywhere
// (framework/numerics/README.md, "Closed forms"; hard case 20).
#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/scene/files/scene_file.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

constexpr double kIndex = 1.333;
constexpr double kFloorHeight = -1.2;
constexpr double kFloorIrradiance =
    1000.0 * (1.0 - (kIndex - 1.0) * (kIndex - 1.0) / ((kIndex + 1.0) * (kIndex + 1.0)));

// Relative deviations from the closed form at the floor pixels that are so far from the walls, m:
// by default farther than a splat's radius (2.5 footprints of 4 m/256 = 0.04 m), where light is
// missing beyond the edge.
std::vector<double> floorDeviations(const Frame& frame, double margin = 0.15) {
    const Texels receiver = frame.read("eye.receiver");
    const Texels irradiance = frame.causticIrradiance();
    std::vector<double> deviations;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const double depth = static_cast<double>(receiver.at(x, y, 0));
            if (depth <= 0.0) continue;
            const glm::dvec3 world = frame.worldAt(x, y, depth);
            const bool isFloor = std::abs(world.y - kFloorHeight) < 1e-3;
            const bool isInside =
                std::abs(world.x) < 2.0 - margin && std::abs(world.z) < 1.5 - margin;
            if (!isFloor || !isInside) continue;
            deviations.push_back(irradiance.rgb(x, y).g / kFloorIrradiance - 1.0);
        }
    }
    return deviations;
}

TEST(FlatWater, FloorIrradianceIsTheClosedFormInEveryPixelAwayFromTheEdges) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const Frame frame(scene, 800, 600);
    std::vector<double> deviations = floorDeviations(frame);
    ASSERT_GT(deviations.size(), 100000u);
    const double mean = std::accumulate(deviations.begin(), deviations.end(), 0.0) /
                        static_cast<double>(deviations.size());
    std::sort(deviations.begin(), deviations.end(),
              [](double a, double b) { return std::abs(a) < std::abs(b); });
    const double worst = std::abs(deviations.back());
    RecordProperty("mean_ppm", static_cast<int>(1e6 * mean));
    RecordProperty("worst_ppm", static_cast<int>(1e6 * worst));
    EXPECT_LT(std::abs(mean), 1e-3);
    // 1 % is what the project promises.
    EXPECT_LT(worst, 1e-2);
}

TEST(FlatWater, FloorIrradianceOfTrianglesIsTheClosedFormMoreClosely) {
    const scene::Scene scene = scene::loadScene("flat-water");
    // Of cells smaller than a pixel, each is spread over those that it touches by what they see of
    // the floor, which is not the same all over a pixel.
    for (const auto& [photons, bound] : {std::pair{"32x32", 1e-4}, {"256x256", 1e-3}}) {
        const Frame frame(scene, 320, 240,
                          {{"emit.photons", photons}, {"reconstruct", "triangles"}});
        const std::vector<double> deviations = floorDeviations(frame);
        ASSERT_GT(deviations.size(), 10000u);
        double worst = 0.0;
        for (const double deviation : deviations)
            worst = std::max(worst, std::abs(deviation));
        RecordProperty(std::string("worst_ppm_") + photons, static_cast<int>(1e6 * worst));
        EXPECT_LT(worst, bound) << photons;
    }
}

// Beams of many pixels put their light into squares of them (triangles_pixel_blocks.glsl), and
// those next to each other share a square as they share its area.
TEST(FlatWater, FloorIrradianceOfWideBeamsIsTheClosedFormAcrossTheirBorders) {
    const scene::Scene scene = scene::loadScene("flat-water");
    for (const auto& [photons, cell] : {std::pair{"16x16", 0.25}, {"40x40", 0.1}}) {
        const Frame frame(
            scene, 322, 241,
            {{"emit.photons", photons}, {"driver", "hierarchical"}, {"reconstruct", "triangles"}});
        // Cells at the walls are cut off by them.
        const std::vector<double> deviations = floorDeviations(frame, 0.05 + 2.0 * cell);
        ASSERT_GT(deviations.size(), 5000u);
        double worst = 0.0;
        for (const double deviation : deviations)
            worst = std::max(worst, std::abs(deviation));
        RecordProperty(std::string("worst_ppm_") + photons, static_cast<int>(1e6 * worst));
        EXPECT_LT(worst, 1e-3) << photons;
    }
}

TEST(FlatWater, BlocksDirectLightSoThatNothingCountsTwice) {
    const scene::Scene scene = scene::loadScene("flat-water");
    const Frame frame(scene, 400, 300, {{"emit.photons", "64x64"}}, {"direct.irradiance"});
    const Texels receiver = frame.read("eye.receiver");
    const Texels direct = frame.read("direct.irradiance");
    int floorPixels = 0;
    int deckPixels = 0;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const glm::dvec3 world = frame.worldAt(x, y, static_cast<double>(receiver.at(x, y, 0)));
            const bool isInside = std::abs(world.x) < 1.9 && std::abs(world.z) < 1.4;
            if (isInside && world.y < -1.1) {
                ++floorPixels;
                EXPECT_EQ(direct.at(x, y, 1), 0.0f);
            }
            const bool isOnDeck = std::abs(world.x) > 2.1 || std::abs(world.z) > 1.6;
            if (isOnDeck && world.y > 0.2) {
                ++deckPixels;
                EXPECT_NEAR(direct.at(x, y, 1), 1000.0f, 1e-2f);
            }
        }
    }
    EXPECT_GT(floorPixels, 10000);
    EXPECT_GT(deckPixels, 1000);
}

TEST(FlatWater, LedgerBalances) {
    const scene::Scene scene = scene::loadScene("flat-water");
    Frame frame(scene, 400, 300);
    const EnergyLedger ledger = frame.renderer().ledger();
    // The water that the deck leaves open is 4 m by 3 m, at 1000 W/m². The grid's texels at its
    // edge are 4.04 m / 256 wide, hence the tolerance.
    EXPECT_NEAR(ledger.watts[transport::kAccountEmitted], 12000.0, 12000.0 * 0.005);
    EXPECT_LT(std::abs(ledger.balance()), 1e-3);
    EXPECT_NEAR(
        ledger.watts[transport::kAccountUntracedBranch] / ledger.watts[transport::kAccountEmitted],
        1.0 - kFloorIrradiance / 1000.0, 1e-6);
}

}  // namespace
}  // namespace kaustik::test
