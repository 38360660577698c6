// SPDX-License-Identifier: MIT
#include "framework/gui/camera_control.h"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/gui/photon_probe.h"

namespace kaustik::gui::test {
namespace {

scene::Camera camera() {
    scene::Camera camera;
    camera.position = {1.0, 2.0, 4.0};
    camera.target = {0.5, 0.0, 0.0};
    return camera;
}

double length(const glm::dvec3& v) {
    return glm::length(v);
}

TEST(CameraControl, OrbitKeepsTheTargetAndTheDistance) {
    const scene::Camera before = camera();
    const scene::Camera after = orbit(before, {120.0, -37.0}, 600.0);
    EXPECT_EQ(after.target, before.target);
    EXPECT_NEAR(length(after.position - after.target), length(before.position - before.target),
                1e-12);
    EXPECT_GT(length(after.position - before.position), 0.1);
}

TEST(CameraControl, OrbitByThePicturesHeightTwiceIsAWholeTurn) {
    const scene::Camera before = camera();
    const scene::Camera after = orbit(before, {1200.0, 0.0}, 600.0);
    EXPECT_LT(length(after.position - before.position), 1e-9);
}

TEST(CameraControl, OrbitNeverReachesThePole) {
    scene::Camera turned = camera();
    for (int i = 0; i < 100; ++i)
        turned = orbit(turned, {3.0, 200.0}, 600.0);
    const glm::dvec3 offset = glm::normalize(turned.position - turned.target);
    EXPECT_GT(length(glm::cross(offset, turned.up)), 0.01);
    EXPECT_TRUE(std::isfinite(turned.position.x));
}

TEST(CameraControl, LookKeepsThePositionAndTheDistance) {
    const scene::Camera before = camera();
    const scene::Camera after = look(before, {50.0, 20.0}, 600.0);
    EXPECT_EQ(after.position, before.position);
    EXPECT_NEAR(length(after.target - after.position), length(before.target - before.position),
                1e-12);
}

TEST(CameraControl, DollyComesNearerAndNeverArrives) {
    scene::Camera nearer = camera();
    const double before = length(nearer.position - nearer.target);
    nearer = dolly(nearer, 1.0);
    EXPECT_NEAR(length(nearer.position - nearer.target), 0.9 * before, 1e-12);
    for (int i = 0; i < 500; ++i)
        nearer = dolly(nearer, 5.0);
    EXPECT_GE(length(nearer.position - nearer.target), 1.9 * nearer.nearMeters);
}

TEST(CameraControl, FlyMovesAlongTheCamerasOwnAxes) {
    const scene::Camera before = camera();
    const scene::Camera after = fly(before, {0.0, 0.0, 0.5});
    const glm::dvec3 forward = glm::normalize(before.target - before.position);
    EXPECT_LT(length(after.position - (before.position + 0.5 * forward)), 1e-12);
    EXPECT_LT(length((after.target - after.position) - (before.target - before.position)), 1e-12);
}

// A handle that is dragged by some pixels must be seen there afterwards.
TEST(LightHandle, FollowsTheHand) {
    scene::Bounds bounds;
    bounds.include({-1.0, -1.0, -1.0});
    bounds.include({1.0, 1.0, 1.0});
    const render::RasterView view = render::makeEyeView(camera(), 800, 600);
    const auto seen = [&](const scene::Light& light) {
        return project(view,
                       glm::vec3(view.worldToView * glm::dvec4(lightHandle(light, bounds), 1.0)))
            .pixel;
    };
    scene::Light lamp;
    lamp.kind = scene::LightKind::point;
    lamp.position = {0.2, 1.0, 0.3};
    const glm::vec2 lampAt = seen(lamp);
    lamp = dragLight(lamp, bounds, view, {40.0, -25.0});
    EXPECT_NEAR(seen(lamp).x, lampAt.x + 40.0f, 0.01);
    EXPECT_NEAR(seen(lamp).y, lampAt.y - 25.0f, 0.01);

    scene::Light sun;
    sun.direction = glm::normalize(glm::dvec3(0.2, -1.0, 0.1));
    const glm::vec2 sunAt = seen(sun);
    sun = dragLight(sun, bounds, view, {10.0, 0.0});
    EXPECT_NEAR(glm::length(sun.direction), 1.0, 1e-12);
    // On a sphere about the middle of the scene: the same way, a little less far.
    EXPECT_GT(seen(sun).x, sunAt.x + 5.0f);
    EXPECT_LT(seen(sun).x, sunAt.x + 11.0f);
}

TEST(Projection, IsTheOneOfTheDevice) {
    const render::RasterView view = render::makeEyeView(camera(), 800, 600);
    EXPECT_EQ(project(view, {0.0f, 0.0f, -2.0f}).pixel, glm::vec2(400.0f, 300.0f));
    const auto top = static_cast<float>(2.0 * view.halfExtent.y);
    EXPECT_NEAR(project(view, {0.0f, top, -2.0f}).pixel.y, 0.0f, 1e-3);
    EXPECT_FALSE(project(view, {0.0f, 0.0f, 1.0f}).visible);
    EXPECT_FALSE(project(view, {0.0f, 0.0f, -0.5f * static_cast<float>(view.nearMeters)}).visible);
}

}  // namespace
}  // namespace kaustik::gui::test
