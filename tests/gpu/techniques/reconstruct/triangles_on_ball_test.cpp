// SPDX-License-Identifier: MIT
// Triangles on what turns away from the light: through a sheet that bends nothing the sun shines on
// a ball from the side, so that the eye sees where its light ends. Irradiance is the sun's by the
// cosine, and none beyond.
#include <algorithm>
#include <cmath>

#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

constexpr double kSun = 100.0;  // W/m²
const glm::dvec3 kDirection(0.8, -0.6, 0.0);

scene::Scene ballUnderAir() {
    return sceneFromText(R"(
name = "ball under air"
[camera]
position = [0, 0, 2.5]
target = [0, 0, 0]
[[light]]
name = "sun"
type = "directional"
irradiance = 100
direction = [0.8, -0.6, 0]
[[material]]
name = "grey"
type = "lambertian"
albedo = 0.5
[[material]]
name = "air"
type = "dielectric"
ior = 1
[[object]]
name = "sheet"
shape = "plane"
material = "air"
size = [4, 4]
position = [-1.2, 0.9, 0]
[[object]]
name = "ball"
shape = "sphere"
material = "grey"
radius = 0.5
)");
}

class TrianglesOnABall : public testing::TestWithParam<const char*> {};

TEST_P(TrianglesOnABall, FollowTheCosineAndEndWhereItDoes) {
    const Frame frame(ballUnderAir(), 240, 240,
                      {{"trace", GetParam()}, {"emit.photons", "256x256"}});
    const Texels irradiance = frame.causticIrradiance();
    const Texels receiver = frame.read("eye.receiver");
    int lit = 0;
    double error = 0.0;
    double leaked = 0.0;
    double nearTheEnd = 0.0;
    double expectedThere = 0.0;
    for (int y = 0; y < receiver.height; ++y) {
        for (int x = 0; x < receiver.width; ++x) {
            const double depth = receiver.at(x, y, 0);
            if (depth <= 0.0) continue;
            const glm::dvec3 normal = glm::normalize(frame.worldAt(x, y, depth));
            const double cosine = -glm::dot(normal, kDirection);
            const double found = irradiance.at(x, y, 0);
            if (cosine < -0.02) leaked = std::max(leaked, found);
            // A cell is 12 cm long where it arrives at this cosine.
            if (cosine >= 0.0 && cosine < 0.2) {
                nearTheEnd += found;
                expectedThere += kSun * cosine;
            }
            // But for the outline, where a pixel sees next to nothing of what is lit.
            if (cosine < 0.25 || normal.z < 0.3) continue;
            ++lit;
            error += std::abs(found / (kSun * cosine) - 1.0);
        }
    }
    ASSERT_GT(lit, 3000);
    // The search on the screen knows where light lands to a pixel only.
    EXPECT_LT(error / lit, GetParam() == std::string("bvh") ? 0.015 : 0.025);
    EXPECT_EQ(leaked, 0.0);
    EXPECT_NEAR(nearTheEnd / expectedThere, 1.0, 0.12);
}

INSTANTIATE_TEST_SUITE_P(By, TrianglesOnABall, testing::Values("bvh", "hierarchical"));

}  // namespace
}  // namespace kaustik::test
