// SPDX-License-Identifier: MIT
// Lens and paraboloid: the surface, and where it sends light.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/core/error.h"
#include "framework/scene/shapes/shapes.h"
#include "tests/unit/scene/shapes/shapes_measures.h"

namespace kaustik::scene {
namespace {

constexpr double kPi = glm::pi<double>();

double capHeight(double curvature, double rim) {
    if (curvature == 0.0) return 0.0;
    const double r = std::abs(curvature);
    return std::copysign(r - std::sqrt(r * r - rim * rim), curvature);
}

double capVolume(double curvature, double rim) {
    const double h = std::abs(capHeight(curvature, rim));
    return std::copysign(kPi * h * h * (3.0 * std::abs(curvature) - h) / 3.0, curvature);
}

// Upper face when `side` is 1, lower when -1: every vertex at its sphere, with the sphere's normal.
void expectOnSphere(const Mesh& lens, double side, double curvature, double vertexY) {
    int points = 0;
    for (std::size_t i = 0; i < lens.positions.size(); ++i) {
        const glm::dvec3 p(lens.positions[i]);
        const glm::dvec3 normal(lens.normals[i]);
        if (normal.y * side <= 1e-9) continue;
        ++points;
        if (curvature == 0.0) {
            ASSERT_NEAR(p.y, side * vertexY, 1e-7);
            continue;
        }
        const glm::dvec3 center(0.0, side * (vertexY - curvature), 0.0);
        // Positions are rounded to 2^-24 of at most 1 m.
        ASSERT_NEAR(glm::length(p - center), std::abs(curvature), 2e-7);
        ASSERT_LT(glm::length((p - center) / curvature - normal), 1e-6);
    }
    EXPECT_GT(points, 10);
}

TEST(Lens, LiesOnItsTwoSpheresAndHasTheirVolume) {
    struct Case {
        double top, bottom;
    };
    for (const auto [top, bottom] : {Case{1.5, 1.5}, Case{0.9, 0.0}, Case{0.0, 2.0},
                                     Case{-1.2, -0.8}, Case{1.0, -2.0}, Case{0.5, 0.5}}) {
        SCOPED_TRACE(testing::Message() << "radii " << top << " and " << bottom);
        LensShape shape;
        shape.topRadius = top;
        shape.bottomRadius = bottom;
        shape.diameter = 1.0;
        shape.edgeThickness = 0.5;
        shape.segments = 96;
        const Mesh lens = makeLens(shape);
        test::expectSound(lens);
        EXPECT_TRUE(lens.closed);
        EXPECT_TRUE(test::everyEdgeHasTwoTriangles(lens));
        const double center = 0.5 + capHeight(top, 0.5) + capHeight(bottom, 0.5);
        expectOnSphere(lens, 1.0, top, 0.5 * center);
        expectOnSphere(lens, -1.0, bottom, 0.5 * center);

        const double smooth = kPi * 0.25 * 0.5 + capVolume(top, 0.5) + capVolume(bottom, 0.5);
        // A face of 24 rings is a chain of chords that leave its circle by at most
        // R (1 - cos(step/2)), over the area of the cap.
        double tolerance = 1e-6;
        for (const double radius : {top, bottom}) {
            if (radius == 0.0) continue;
            const double step = std::asin(0.5 / std::abs(radius)) / 24.0;
            tolerance += 2.0 * kPi * std::abs(radius * capHeight(radius, 0.5)) * std::abs(radius) *
                         (1.0 - std::cos(0.5 * step));
        }
        EXPECT_NEAR(test::volume(lens) / test::polygonShare(96), smooth, tolerance);
    }
}

TEST(Lens, TakesEitherThickness) {
    LensShape shape;
    shape.topRadius = 1.0;
    shape.bottomRadius = -3.0;
    shape.edgeThickness = 0.2;
    const Mesh byEdge = makeLens(shape);
    shape.centerThickness = 0.2 + capHeight(1.0, 0.5) + capHeight(-3.0, 0.5);
    shape.edgeThickness = 0.0;
    const Mesh byCenter = makeLens(shape);
    EXPECT_NEAR(test::volume(byEdge), test::volume(byCenter), 1e-6);
}

TEST(Lens, PlanoConvexFocusesAtRadiusOverIndexMinusOne) {
    LensShape shape;
    shape.topRadius = 2.0;
    shape.bottomRadius = 0.0;
    shape.edgeThickness = 0.1;
    shape.segments = 512;
    const Mesh lens = makeLens(shape);
    const double n = 1.5;
    int rays = 0;
    for (std::size_t i = 0; i < lens.positions.size(); ++i) {
        // Light from below crosses the flat face unbent and leaves through the top, near the axis.
        const glm::dvec3 p(lens.positions[i]);
        const glm::dvec3 normal(lens.normals[i]);
        const double h = std::hypot(p.x, p.z);
        if (normal.y < 0.5 || h < 0.02 || h > 0.08) continue;
        const glm::dvec3 out = glm::refract(glm::dvec3(0.0, 1.0, 0.0), -normal, n);
        const double crossing = p.y - h * out.y / ((out.x * p.x + out.z * p.z) / h);
        const double top = 0.5 * (0.1 + capHeight(2.0, 0.5));
        // Spherical aberration shortens the focus by (n² h²)/(2 R (n-1)) for this orientation: with
        // h = 0.08, 7.2 mm of 4 m.
        EXPECT_NEAR(crossing - top, 2.0 / (n - 1.0), 1.1 * n * n * h * h / (2.0 * 2.0 * (n - 1.0)));
        ++rays;
    }
    EXPECT_GT(rays, 100);
}

TEST(Lens, SaysWhyItCannotBe) {
    const auto message = [](const LensShape& shape) -> std::string {
        try {
            (void)makeLens(shape);
        } catch (const ConfigError& error) {
            return error.what();
        }
        return "";
    };
    LensShape shape;
    EXPECT_NE(message(shape).find("Exactly one of"), std::string::npos);
    shape.edgeThickness = 0.1;
    shape.centerThickness = 0.1;
    EXPECT_NE(message(shape).find("Exactly one of"), std::string::npos);
    shape.edgeThickness = 0.0;
    EXPECT_NE(message(shape).find("faces cross"), std::string::npos);
    shape.topRadius = 0.4;
    EXPECT_NE(message(shape).find("top_radius"), std::string::npos);
    shape.topRadius = std::nan("");
    EXPECT_NE(message(shape).find("top_radius"), std::string::npos);
}

TEST(Paraboloid, SendsEveryAxialRayThroughItsFocus) {
    const double f = 0.75;
    const Mesh mirror = makeParaboloid({f, 2.0, 96});
    test::expectSound(mirror);
    EXPECT_FALSE(mirror.closed);
    const glm::dvec3 focus(0.0, f, 0.0);
    for (std::size_t i = 0; i < mirror.positions.size(); ++i) {
        const glm::dvec3 p(mirror.positions[i]);
        ASSERT_GT(mirror.normals[i].y, 0.0f);  // on the side of the focus
        ASSERT_NEAR(p.y, (p.x * p.x + p.z * p.z) / (4.0 * f), 1e-7);
        const glm::dvec3 out =
            glm::reflect(glm::dvec3(0.0, -1.0, 0.0), glm::dvec3(mirror.normals[i]));
        // Rounding of the normal to 2^-24 turns the ray by about 1e-7, over at most 1.1 m.
        ASSERT_LT(glm::length(glm::cross(focus - p, out)), 5e-7);
        ASSERT_GT(glm::dot(focus - p, out), 0.0);
    }
}

}  // namespace
}  // namespace kaustik::scene
