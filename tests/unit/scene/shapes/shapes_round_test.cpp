// SPDX-License-Identifier: MIT
// Round shapes against closed forms. What is revolved is an n-gon in every section, so that its
// volume is the smooth one times `polygonShare(n)`, exactly; only the sphere needs bounds.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/core/error.h"
#include "framework/scene/shapes/shapes.h"
#include "tests/unit/scene/shapes/shapes_measures.h"

namespace kaustik::scene {
namespace {

constexpr double kPi = glm::pi<double>();
// Rounding of positions to 2^-24, which adds up in no direction.
constexpr double kRounding = 1e-6;

TEST(Sphere, LiesOnItsSurfaceWithExactNormals) {
    const Mesh sphere = makeSphere({0.7, 64});
    test::expectSound(sphere);
    EXPECT_TRUE(sphere.closed);
    EXPECT_TRUE(test::everyEdgeHasTwoTriangles(sphere));
    for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
        const glm::dvec3 position(sphere.positions[i]);
        ASSERT_NEAR(glm::length(position), 0.7, 1e-7);
        ASSERT_LT(glm::length(position / 0.7 - glm::dvec3(sphere.normals[i])), 3e-7);
    }
}

TEST(Sphere, ApproachesItsVolumeAndAreaFromBelow) {
    for (const unsigned segments : {8u, 32u, 128u}) {
        const Mesh sphere = makeSphere({0.7, segments});
        // A cell is no wider than 2π/segments either way, so that each face comes no nearer to the
        // centre than R cos(half its diagonal).
        const double nearest = std::cos(std::sqrt(0.5) * 2.0 * kPi / segments);
        const double volume = test::volume(sphere) / (4.0 / 3.0 * kPi * 0.343);
        const double area = test::area(sphere) / (4.0 * kPi * 0.49);
        EXPECT_LT(volume, 1.0);
        EXPECT_GT(volume, std::pow(nearest, 3));
        EXPECT_LT(area, 1.0);
        EXPECT_GT(area, std::pow(nearest, 2));
    }
}

TEST(Sphere, HasAsManyEdgesAroundTheEquatorAsSegments) {
    const Mesh sphere = makeSphere({1.0, 64});
    int onEquator = 0;
    for (const glm::uvec3& triangle : sphere.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            onEquator += sphere.positions[triangle[corner]].y == 0.0f &&
                         sphere.positions[triangle[(corner + 1) % 3]].y == 0.0f;
        }
    }
    EXPECT_EQ(onEquator, 2 * 64);  // each edge from both sides
    EXPECT_EQ(makeSphere({1.0, 61}).triangles.size(), sphere.triangles.size());
}

TEST(Cylinder, HasTheVolumeAndAreaOfItsPolygon) {
    const Mesh cylinder = makeCylinder({0.4, 1.5, false, false, 48});
    test::expectSound(cylinder);
    EXPECT_TRUE(cylinder.closed);
    EXPECT_TRUE(test::everyEdgeHasTwoTriangles(cylinder));
    const double base = kPi * 0.16 * test::polygonShare(48);
    const double side = 48 * 2.0 * 0.4 * std::sin(kPi / 48) * 1.5;
    EXPECT_NEAR(test::volume(cylinder), base * 1.5, kRounding);
    EXPECT_NEAR(test::area(cylinder), 2.0 * base + side, 5.0 * kRounding);
}

TEST(Cylinder, OpenAndInwardIsTheInsideOfATube) {
    const Mesh tube = makeCylinder({0.4, 1.5, true, true, 48});
    test::expectSound(tube);
    EXPECT_FALSE(tube.closed);
    EXPECT_EQ(tube.triangles.size(), 96u);
    for (std::size_t i = 0; i < tube.positions.size(); ++i) {
        const glm::dvec3 p(tube.positions[i]);
        const glm::dvec3 towardsAxis = -glm::dvec3(p.x, 0.0, p.z) / 0.4;
        EXPECT_LT(glm::length(glm::dvec3(tube.normals[i]) - towardsAxis), kRounding);
    }
}

TEST(Ring, HasTheVolumeBetweenItsWalls) {
    const Mesh ring = makeRing({0.45, 0.5, 0.2, 64});
    test::expectSound(ring);
    EXPECT_TRUE(ring.closed);
    EXPECT_TRUE(test::everyEdgeHasTwoTriangles(ring));
    const double expected = kPi * (0.25 - 0.2025) * 0.2 * test::polygonShare(64);
    EXPECT_NEAR(test::volume(ring), expected, kRounding * expected);
    int inner = 0;
    for (std::size_t i = 0; i < ring.positions.size(); ++i) {
        const glm::vec3& p = ring.positions[i];
        if (ring.normals[i].y != 0.0f || std::hypot(p.x, p.z) > 0.47f) continue;
        EXPECT_LT(p.x * ring.normals[i].x + p.z * ring.normals[i].z, 0.0f);
        ++inner;
    }
    EXPECT_EQ(inner, 2 * 65);
}

TEST(Torus, HasTheVolumeThatPappusGivesIt) {
    const Mesh torus = makeTorus({0.5, 0.15, 64, 32});
    test::expectSound(torus);
    EXPECT_TRUE(torus.closed);
    EXPECT_TRUE(test::everyEdgeHasTwoTriangles(torus));
    const double section = kPi * 0.0225 * test::polygonShare(32);
    const double expected = 2.0 * kPi * 0.5 * section * test::polygonShare(64);
    EXPECT_NEAR(test::volume(torus), expected, kRounding * expected);
    for (std::size_t i = 0; i < torus.positions.size(); ++i) {
        const glm::dvec3 p(torus.positions[i]);
        const glm::dvec3 middle = 0.5 * glm::normalize(glm::dvec3(p.x, 0.0, p.z));
        ASSERT_LT(glm::length(middle + 0.15 * glm::dvec3(torus.normals[i]) - p), 2e-7);
    }
}

TEST(RoundShapes, StayClosedAtTheCoarsestAndAtOddTessellations) {
    for (const unsigned segments : {3u, 5u, 7u, 97u, 101u}) {
        EXPECT_TRUE(makeCylinder({0.3, 1.0, false, false, segments}).closed);
        EXPECT_TRUE(makeRing({0.3, 0.7, 0.1, segments}).closed);
        EXPECT_TRUE(makeTorus({0.5, 0.1, segments, segments}).closed);
        EXPECT_TRUE(makeSphere({0.3, segments + 1}).closed);
    }
}

TEST(RoundShapes, RejectWhatTheyCannotBe) {
    EXPECT_THROW((void)makeSphere({-1.0, 16}), ConfigError);
    EXPECT_THROW((void)makeSphere({1.0, 3}), ConfigError);
    EXPECT_THROW((void)makeSphere({1.0, kMaximumCells + 1}), ConfigError);
    EXPECT_THROW((void)makeCylinder({0.0, 1.0, false, false, 16}), ConfigError);
    EXPECT_THROW((void)makeCylinder({1.0, HUGE_VAL, false, false, 16}), ConfigError);
    EXPECT_THROW((void)makeRing({0.5, 0.5, 1.0, 16}), ConfigError);
    EXPECT_THROW((void)makeTorus({0.5, 0.5, 16, 16}), ConfigError);
    EXPECT_THROW((void)makeTorus({0.5, 0.1, 16, 2}), ConfigError);
}

}  // namespace
}  // namespace kaustik::scene
