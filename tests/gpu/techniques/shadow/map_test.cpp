// SPDX-License-Identifier: MIT
// shadow.map on the device: how its edges are filtered, against the closed form of a ball's shadow
// and of a grating's.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "framework/render/view.h"
#include "tests/gpu/fixture.h"
#include "tests/gpu/techniques/scene_parts.h"

namespace kaustik::test {
namespace {

// A floor under a sun straight above, seen by a camera given as TOML; all is grey.
scene::Scene underTheSun(const std::string& name, const std::string& camera,
                         const std::string& objects) {
    return sceneFromText("name = '" + name + "'\n[camera]\n" + camera + R"(
[[light]]
name = "sun"
type = "directional"
irradiance = 100
direction = [0, -1, 0]
)" + greyFloor(4.0) + objects);
}

constexpr double kBallRadius = 0.5;
scene::Scene ballAboveTheFloor() {
    return underTheSun("ball", "position = [0.4, 0.45, 0.9]\ntarget = [0.35, 0, 0.35]", R"(
[[object]]
name = "ball"
shape = "sphere"
material = "grey"
radius = 0.5
segments = 512
position = [0, 1, 0]
)");
}

// Metres that a texel of the sun's map covers.
glm::dvec2 texelOfMap(const scene::Scene& scene, int side) {
    const scene::Bounds bounds = scene::sceneBounds(scene);
    return 2.0 * render::makeLightView(scene.lights.front(), bounds, bounds).halfExtent /
           static_cast<double>(side);
}

// Pixels of the floor, and how much of the sun reaches them.
struct FloorShadow {
    FloorShadow(const scene::Scene& scene, int width, int height, int side)
        : frame(scene, width, height, {{"shadow.map.size", fmt::format("{}", side)}},
                {"shadow.visibility", "eye.receiver"}),
          visibility(frame.read("shadow.visibility")),
          receiver(frame.read("eye.receiver")) {}
    // False: the pixel shows something else.
    bool onFloor(int x, int y, glm::dvec3& point) const {
        const double depth = static_cast<double>(receiver.at(x, y, 0));
        if (depth <= 0.0) return false;
        point = frame.worldAt(x, y, depth);
        return std::abs(point.y) < 1e-3;
    }
    [[nodiscard]] double lit(int x, int y) const {
        return static_cast<double>(visibility.at(x, y, 0));
    }
    Frame frame;
    Texels visibility;
    Texels receiver;
};

TEST(ShadowMap, HasNoStepsWhereThePictureMagnifiesIt) {
    const scene::Scene scene = ballAboveTheFloor();
    constexpr int kSide = 64;
    const FloorShadow shadow(scene, 320, 240, kSide);
    const glm::dvec2 texel = texelOfMap(scene, kSide);
    int partly = 0;
    double worst = 0.0;
    double largestStep = 0.0;
    glm::dvec3 here;
    glm::dvec3 neighbour;
    for (int y = 0; y < 240; ++y) {
        for (int x = 0; x + 1 < 320; ++x) {
            if (!shadow.onFloor(x, y, here) || !shadow.onFloor(x + 1, y, neighbour)) continue;
            partly += shadow.lit(x, y) > 0.0 && shadow.lit(x, y) < 1.0 ? 1 : 0;
            const double texels =
                std::abs(neighbour.x - here.x) / texel.x + std::abs(neighbour.z - here.z) / texel.y;
            const double step = std::abs(shadow.lit(x + 1, y) - shadow.lit(x, y));
            // What a square of three texels holds changes by a third of what it moves.
            worst = std::max(worst, step - texels / 3.0);
            largestStep = std::max(largestStep, texels);
        }
    }
    EXPECT_GT(partly, 1000);
    EXPECT_LT(largestStep, 0.5);  // it is magnified
    // Positions of 32 bits, seen through two projections.
    EXPECT_LT(worst, 2e-4);
}

TEST(ShadowMap, FindsTheShadowOfABallToATexel) {
    const scene::Scene scene = ballAboveTheFloor();
    for (const int side : {64, 256, 1024}) {
        SCOPED_TRACE(side);
        const FloorShadow shadow(scene, 320, 240, side);
        const glm::dvec2 texel = texelOfMap(scene, side);
        int dark = 0;
        int lit = 0;
        int wrong = 0;
        int dim = 0;
        glm::dvec3 point;
        for (int y = 0; y < 240; ++y) {
            for (int x = 0; x < 320; ++x) {
                if (!shadow.onFloor(x, y, point)) continue;
                const double outside = std::hypot(point.x, point.z) - kBallRadius;
                // A texel's middle decides for all of it; a pixel here is 3 mm.
                if (std::abs(outside) < 0.75 * std::max(texel.x, texel.y) + 0.003) continue;
                const double share = shadow.lit(x, y);
                ++(outside < 0.0 ? dark : lit);
                wrong += (share > 0.5) != (outside > 0.0) ? 1 : 0;
                // Beyond the filter there is nothing but the sun.
                dim += outside > 3.0 * std::max(texel.x, texel.y) + 0.003 && share < 1.0 ? 1 : 0;
            }
        }
        EXPECT_GT(dark, 5000);
        EXPECT_GT(lit, 5000);
        EXPECT_EQ(wrong, 0);
        EXPECT_EQ(dim, 0);
    }
}

TEST(ShadowMap, AveragesOverThePixelWhatIsFiner) {
    // Slats as wide as the gaps between them, above the camera: half of the sun reaches the floor.
    std::string slats;
    constexpr double kPeriod = 0.04;
    for (int i = 0; i < 100; ++i) {
        slats += fmt::format(R"(
[[object]]
name = "slat {}"
shape = "plane"
material = "grey"
size = [{}, 4]
position = [{}, 2, 0]
)",
                             i, 0.5 * kPeriod, -2.0 + kPeriod * (i + 0.25));
    }
    const scene::Scene scene = underTheSun(
        "grating",
        "position = [0, 1, 0]\ntarget = [0.01, 0, 0]\nup = [0, 0, -1]\nvertical_fov_degrees = 90",
        slats);
    // A pixel is 4.2 cm, a texel 2 mm.
    const FloorShadow shadow(scene, 64, 48, 2048);
    double sum = 0.0;
    double squares = 0.0;
    int pixels = 0;
    glm::dvec3 point;
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            if (!shadow.onFloor(x, y, point)) continue;
            sum += shadow.lit(x, y);
            squares += (shadow.lit(x, y) - 0.5) * (shadow.lit(x, y) - 0.5);
            ++pixels;
        }
    }
    ASSERT_GT(pixels, 2000);
    RecordProperty("rms_ppm", static_cast<int>(1e6 * std::sqrt(squares / pixels)));
    EXPECT_NEAR(sum / pixels, 0.5, 0.02);
    // One comparison a pixel would be off by 0.5; three looks across a period by up to a sixth.
    EXPECT_LT(std::sqrt(squares / pixels), 0.17);
}

}  // namespace
}  // namespace kaustik::test
