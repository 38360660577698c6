// SPDX-License-Identifier: MIT
// Where generators are looked at from.
#include "techniques/generators/reference_points.h"

#include <gtest/gtest.h>

#include "framework/numerics/cases/scene_text.h"

namespace kaustik::test {
namespace {

using namespace numerics;

const std::string kFloor = floorPlane("floor", "grey", 12, {0, 0, 0});

// Of light from a ball on all sides all comes to a floor that its middle sees but at grazing
// angles.
TEST(ReferencePoints, OfABallAreItsMiddle) {
    const scene::Scene scene =
        makeScene({}, sun({0, -1, 0}) + kFloor +
                          object("ball", "sphere", "glass", {0, 1, 0}, "radius = 0.3"));
    const scene::SurfaceRays rays(scene, scene::receiversOf(scene));
    const scene::Bounds bounds = objectBounds(scene, scene.objects[1]);
    const ReferencePoints points =
        referencePoints(bounds, placesReached(scene, bounds, rays), rays, 1);
    ASSERT_EQ(points.parts.size(), 1u);
    EXPECT_LT(glm::length(points.parts[0].reference - glm::dvec3(0, 1, 0)), 1e-6);
    EXPECT_GT(points.seenShare, 0.9);
}

TEST(ReferencePoints, OfASheetAroundABlockAreNotInIt) {
    const scene::Scene scene =
        makeScene({}, sun({0, -1, 0}) + kFloor + floorPlane("pond", "water", 4, {0, 1, 0}) +
                          object("pillar", "box", "white", {0, 1.5, 0}, "size = [1.2, 3, 1.2]"));
    const scene::SurfaceRays rays(scene, scene::receiversOf(scene));
    const scene::Bounds bounds = objectBounds(scene, scene.objects[1]);
    const auto reached = placesReached(scene, bounds, rays);
    const ReferencePoints one = referencePoints(bounds, reached, rays, 1);
    const glm::dvec3 point = one.parts[0].reference;
    EXPECT_GT(std::max(std::abs(point.x), std::abs(point.z)), 0.6);
    const ReferencePoints four = referencePoints(bounds, reached, rays, 4);
    EXPECT_EQ(four.parts.size(), 4u);
    EXPECT_GT(four.seenShare, one.seenShare + 0.1);
}

}  // namespace
}  // namespace kaustik::test
