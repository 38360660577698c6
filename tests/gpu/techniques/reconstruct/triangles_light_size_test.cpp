// SPDX-License-Identifier: MIT
// Triangles under a sun that has a size: below the border of a sheet of water light fades as the
// share of the sun's disc that is seen past the border, though one point stands for the disc.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/scene/emitters.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

constexpr double kSun = 100.0;  // W/m²
constexpr double kHeight = 1.0;
constexpr double kDegrees = 6.0;
constexpr double kIndex = 1.333;

scene::Scene borderOfWater() {
    return sceneFromText(R"(
name = "border of water"
[camera]
position = [0.5, 0.6, 0.35]
target = [0.5, 0, 0]
[[light]]
name = "sun"
type = "directional"
irradiance = 100
direction = [0, -1, 0]
angular_diameter_degrees = 6
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[material]]
name = "water"
type = "dielectric"
ior = 1.333
[[object]]
name = "floor"
shape = "plane"
material = "grey"
size = [6, 6]
[[object]]
name = "sheet"
shape = "plane"
material = "water"
size = [1, 3]
position = [0, 1, 0]
)");
}

// Share of a disc's area on one side of a line at `place` of its radius from the middle.
double shareOfDisc(double place) {
    const double t = std::clamp(place, -1.0, 1.0);
    return 0.5 + (t * std::sqrt(1.0 - t * t) + std::asin(t)) / glm::pi<double>();
}

// Mean and largest distance from that, of the sun's irradiance, in the half-shadow and around it.
struct Distance {
    double mean = 0.0;
    double largest = 0.0;
    double energy = 0.0;  // of what is there, relative
};
Distance distanceOf(const Frame& frame) {
    const Texels irradiance = frame.causticIrradiance();
    const Texels receiver = frame.read("eye.receiver");
    const double reach =
        kHeight * std::tan(std::asin(std::sin(glm::radians(0.5 * kDegrees)) / kIndex));
    const double reflected = (kIndex - 1.0) / (kIndex + 1.0);
    const double within = kSun * (1.0 - reflected * reflected);
    Distance distance;
    int count = 0;
    double found = 0.0;
    double expected = 0.0;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const double depth = receiver.at(x, y, 0);
            if (depth <= 0.0) continue;
            const glm::dvec3 at = frame.worldAt(x, y, depth);
            const double place = (0.5 - at.x) / reach;
            if (std::abs(place) > 1.5 || std::abs(at.z) > 0.2) continue;
            const double share = shareOfDisc(place);
            const double error = std::abs(irradiance.at(x, y, 0) / within - share);
            distance.mean += error;
            distance.largest = std::max(distance.largest, error);
            found += irradiance.at(x, y, 0);
            expected += within * share;
            ++count;
        }
    }
    EXPECT_GT(count, 300);
    distance.mean /= count;
    distance.energy = found / expected;
    return distance;
}

// Cells of seven pixels, of two, and smaller than one, which share the disc out.
class TrianglesUnderALargeSun : public testing::TestWithParam<const char*> {};

TEST_P(TrianglesUnderALargeSun, FadeAsItsDiscDoesByOnePoint) {
    scene::Scene scene = borderOfWater();
    scene::placeLightPoints(scene, 1, 64);
    const auto rendered = [&](const char* size) {
        return distanceOf(Frame(scene, 64, 64,
                                {{"trace", "bvh"},
                                 {"emit.photons", GetParam()},
                                 {"reconstruct.triangles.light_size", size}}));
    };
    const Distance widened = rendered("widened");
    const Distance points = rendered("points");
    EXPECT_LT(widened.mean, 0.015);
    EXPECT_LT(widened.largest, 0.08);
    EXPECT_NEAR(widened.energy, 1.0, 0.005);
    EXPECT_GT(points.mean, 0.05);
    EXPECT_NEAR(points.energy, 1.0, 0.03);
}

INSTANTIATE_TEST_SUITE_P(By, TrianglesUnderALargeSun,
                         testing::Values("16x48", "64x192", "256x768"));

}  // namespace
}  // namespace kaustik::test
