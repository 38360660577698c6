// SPDX-License-Identifier: MIT
// Which surfaces rays find on the processor.
#include "framework/scene/surface_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "framework/numerics/cases/scene_text.h"

namespace kaustik::scene {
namespace {

using namespace numerics;

const std::string kFloor = floorPlane("floor", "grey", 12, {0, 0, 0});

std::string block(const glm::dvec3& position) {
    return object("block", "box", "white", position, "size = [1, 1, 1]");
}

TEST(SurfaceRays, FindTheNearestReceiverAndNothingSpecular) {
    const Scene scene = makeScene(
        {}, sun({0, -1, 0}) + kFloor + block({0, 1, 0}) + floorPlane("w", "water", 4, {0, 2, 0}));
    const SurfaceRays rays(scene, receiversOf(scene));
    const auto top = rays.first({0.1, 5, 0.2}, {0, -1, 0});
    ASSERT_TRUE(top.has_value());
    EXPECT_NEAR(top->distance, 3.5, 1e-6);
    EXPECT_NEAR(std::abs(top->normal.y), 1.0, 1e-6);
    const auto floor = rays.first({2.1, 5, 0.2}, {0, -1, 0});
    ASSERT_TRUE(floor.has_value());
    EXPECT_NEAR(floor->distance, 5.0, 1e-6);
    EXPECT_FALSE(rays.isBlocked({2.1, 5, 0.2}, {0, -1, 0}, 4.9));
    EXPECT_FALSE(rays.first({2.1, 5, 0.2}, {0, 1, 0}).has_value());
}

TEST(SurfaceRays, AreTheSameWhateverTheTreeAsOfASphereInClosedForm) {
    const Scene scene = makeScene({}, sun({0, -1, 0}) + object("ball", "sphere", "white", {0, 0, 0},
                                                               "radius = 1\nsegments = 128"));
    const SurfaceRays rays(scene, receiversOf(scene));
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 from =
            3.0 * glm::normalize(
                      glm::dvec3(std::sin(1.7 * i), std::cos(2.3 * i), std::sin(0.9 * i + 1.0)));
        const glm::dvec3 to(0.6 * std::sin(3.1 * i), 0.6 * std::cos(1.3 * i), 0.0);
        const glm::dvec3 direction = glm::normalize(to - from);
        const double along = -glm::dot(from, direction);
        const double off2 = glm::dot(from, from) - along * along;
        const auto hit = rays.first(from, direction);
        ASSERT_TRUE(hit.has_value()) << i;
        // The ball's facets lie up to 1 - cos(π/128) = 3e-4 below it, more along a slanted ray.
        EXPECT_NEAR(hit->distance, along - std::sqrt(1.0 - off2), 2e-3) << i;
    }
}

}  // namespace
}  // namespace kaustik::scene
