// SPDX-License-Identifier: MIT
#include "framework/gui/light_marker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/gui/camera_control.h"

namespace kaustik::gui::test {
namespace {

constexpr double kMargin = 20.0;
// A picture of 200x100 pixels, twice as large in the middle of an area of 600x400.
const PictureArea kArea{{100.0, 50.0}, {700.0, 450.0}, {200.0, 150.0}, 2.0};
const glm::dvec2 kMiddle(400.0, 250.0);

scene::Camera camera() {
    scene::Camera camera;
    camera.position = glm::dvec3(0.0, 0.0, 4.0);
    camera.target = glm::dvec3(0.0);
    camera.up = glm::dvec3(0.0, 1.0, 0.0);
    camera.verticalFovDegrees = 45.0;
    camera.nearMeters = 0.01;
    return camera;
}

std::optional<LightMarker> mark(const glm::dvec3& handle, const scene::Camera& by = camera()) {
    return markLight(render::makeEyeView(by, 200, 100), handle, kArea, kMargin);
}

bool isOnEdge(const glm::dvec2& place) {
    const double x = std::min(std::abs(place.x - 120.0), std::abs(place.x - 680.0));
    const double y = std::min(std::abs(place.y - 70.0), std::abs(place.y - 430.0));
    const bool isWithin =
        place.x > 119.999 && place.x < 680.001 && place.y > 69.999 && place.y < 430.001;
    return isWithin && std::min(x, y) < 1e-9;
}

TEST(LightMarker, IsOnALightThatIsSeen) {
    const std::optional<LightMarker> middle = mark(glm::dvec3(0.0));
    ASSERT_TRUE(middle);
    EXPECT_NEAR(glm::distance(middle->place, kMiddle), 0.0, 1e-9);
    EXPECT_EQ(middle->direction, glm::dvec2(0.0));
    EXPECT_FALSE(middle->isBehind);
    // Outside the picture, but in sight of the area: as far up as the picture is high.
    const double height = 4.0 * std::tan(0.5 * glm::radians(45.0));
    const std::optional<LightMarker> above = mark({0.0, 1.5 * height, 0.0});
    EXPECT_NEAR(above->place.y, 250.0 - 150.0, 1e-9);
    EXPECT_EQ(above->direction, glm::dvec2(0.0));
}

TEST(LightMarker, PointsFromTheEdgeToOneOutsideThePicture) {
    const std::optional<LightMarker> right = mark({50.0, 0.0, 0.0});
    EXPECT_NEAR(right->place.x, 680.0, 1e-9);
    EXPECT_NEAR(right->place.y, 250.0, 1e-9);
    EXPECT_NEAR(right->direction.x, 1.0, 1e-12);
    const std::optional<LightMarker> up = mark({0.0, 50.0, 0.0});
    EXPECT_NEAR(up->place.x, 400.0, 1e-9);
    EXPECT_NEAR(up->place.y, 70.0, 1e-9) << "y goes down";
    EXPECT_FALSE(up->isBehind);
}

TEST(LightMarker, PointsToOneBehindTheEyeOnTheShortestWay) {
    const std::optional<LightMarker> left = mark({-3.0, 0.0, 9.0});
    EXPECT_TRUE(left->isBehind);
    EXPECT_NEAR(left->place.x, 120.0, 1e-9);
    EXPECT_NEAR(left->direction.x, -1.0, 1e-12);
    EXPECT_FALSE(mark({0.0, 0.0, 9.0})) << "straight behind there is no way";
}

// Round once about the scene, past the light and with it behind the eye.
TEST(LightMarker, MovesWithTheViewAndNeverJumps) {
    const glm::dvec3 light(0.0, 1.5, 7.0);
    scene::Camera by = camera();
    std::optional<glm::dvec2> before;
    int seen = 0;
    int outside = 0;
    int behind = 0;
    double way = 0.0;
    constexpr int kSteps = 4000;
    for (int step = 0; step < kSteps; ++step) {
        by = orbit(by, {2.0 / kSteps, 0.0}, 1.0);  // half a turn is 1
        const std::optional<LightMarker> marker = mark(light, by);
        ASSERT_TRUE(marker);
        const bool isSeen = marker->direction == glm::dvec2(0.0);
        if (!isSeen) {
            EXPECT_TRUE(isOnEdge(marker->place)) << step;
        }
        seen += isSeen ? 1 : 0;
        outside += !isSeen && !marker->isBehind ? 1 : 0;
        behind += marker->isBehind ? 1 : 0;
        if (before) {
            const double moved = glm::distance(marker->place, *before);
            // A turn of 0.09 degrees, in the middle of 45 degrees over 200 pixels: 0.5 pixels, and
            // more towards the edge; where it passes above the eye, half round the edge in 90
            // degrees.
            EXPECT_LT(moved, 12.0) << step;
            way += moved;
        }
        before = marker->place;
    }
    EXPECT_GT(seen, 0);
    EXPECT_GT(outside, 0);
    EXPECT_GT(behind, 0);
    EXPECT_GT(way, 1000.0);
}

TEST(LightMarker, NeedsRoom) {
    PictureArea small = kArea;
    small.high = small.low + 30.0;
    EXPECT_FALSE(
        markLight(render::makeEyeView(camera(), 200, 100), glm::dvec3(0.0), small, kMargin));
}

}  // namespace
}  // namespace kaustik::gui::test
