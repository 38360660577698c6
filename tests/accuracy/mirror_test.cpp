// SPDX-License-Identifier: MIT
// Caustics of curved mirrors against their closed forms (HARD_CASES.md, F). The mirrors are meshes
// with the exact normals at their vertices; between two vertices an angle h apart the interpolated
// normal's rate of turn is off by about h²/8, which sets the tolerances.
#include <cmath>
#include <numbers>

#include "tests/accuracy/path_fixture.h"

namespace kaustik::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 2.0;
constexpr unsigned kSegments = 2048;
// h²/8 is 1.2e-6; rays that are several facets apart meet with some ten times that. Their distance
// from the envelope, in proportion to the square of the step, is extrapolated away.
constexpr double kEnvelopeTolerance = 5e-5 * kRadius;
constexpr double kStep = 8.0 * 2.0 * kPi / kSegments;

// The envelope's point at `t` of rays that are given by their parameter.
template <class RayAt>
glm::dvec2 envelopePoint(const RayAt& rayAt, double t) {
    const glm::dvec2 wide = crossingPoint(rayAt(t - kStep), rayAt(t + kStep));
    const glm::dvec2 narrow = crossingPoint(rayAt(t - 0.5 * kStep), rayAt(t + 0.5 * kStep));
    return (4.0 * narrow - wide) / 3.0;
}

// The inside of a cylinder whose axis is z, so that the caustic lies in the xy-plane.
scene::Scene mirroredCylinder() {
    scene::CylinderShape shape;
    shape.radius = kRadius;
    shape.height = 1.0;
    shape.open = true;
    shape.inward = true;
    shape.segments = kSegments;
    scene::Scene scene = sceneOf(makeCylinder(shape), mirror());
    scene.objects[0].toWorld = glm::dmat4(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1);
    return scene;
}

TEST(Mirror, ParallelLightInACylinderHasANephroidAsItsEnvelope) {
    const scene::Scene scene = mirroredCylinder();
    const EmbreeScene embree(scene);
    for (double t = -1.2; t < 1.25; t += 0.1) {
        const auto reflected = [&](double angle) {
            return segmentAfter(embree, 1, {-0.3, kRadius * std::sin(angle), 0.0}, {1, 0, 0});
        };
        const glm::dvec2 touch = envelopePoint(reflected, t);
        const glm::dvec2 nephroid = 0.25 * kRadius *
                                    glm::dvec2(3.0 * std::cos(t) - std::cos(3.0 * t),
                                               3.0 * std::sin(t) - std::sin(3.0 * t));
        EXPECT_LT(glm::length(touch - nephroid), kEnvelopeTolerance) << "t = " << t;
    }
}

TEST(Mirror, NephroidHasItsCuspHalfARadiusFromTheAxis) {
    const scene::Scene scene = mirroredCylinder();
    const EmbreeScene embree(scene);
    // Rays at height b cross the axis at R/(2 cos i), sin i = b/R: b → 0 is the cusp.
    for (const double b : {0.02, 0.1, 0.5}) {
        const PathSegment segment = segmentAfter(embree, 1, {-0.3, b, 0.0}, {1, 0, 0});
        const double crossing = 0.5 * kRadius / std::sqrt(1.0 - b * b / (kRadius * kRadius));
        EXPECT_NEAR(segment.crossing(1, 0.0).x, crossing, 2e-4 * kRadius) << "b = " << b;
    }
}

TEST(Mirror, SourceOnTheCylinderHasACardioidAsItsEnvelope) {
    const scene::Scene scene = mirroredCylinder();
    const EmbreeScene embree(scene);
    for (double t = 0.6; t < 2.0 * kPi - 0.55; t += 0.2) {
        const auto reflected = [&](double angle) {
            // A little inside of the wall, along the ray itself.
            const glm::dvec3 source(kRadius, 0, 0);
            const glm::dvec3 target(kRadius * std::cos(angle), kRadius * std::sin(angle), 0);
            return segmentAfter(embree, 1, source + 0.1 * (target - source), target - source);
        };
        const glm::dvec2 touch = envelopePoint(reflected, t);
        const glm::dvec2 cardioid = kRadius / 3.0 *
                                    glm::dvec2(2.0 * std::cos(t) + std::cos(2.0 * t),
                                               2.0 * std::sin(t) + std::sin(2.0 * t));
        EXPECT_LT(glm::length(touch - cardioid), kEnvelopeTolerance) << "t = " << t;
    }
}

TEST(Mirror, ParaboloidSendsAllAxialRaysThroughItsFocus) {
    scene::ParaboloidShape shape;
    shape.focalLength = 1.5;
    shape.diameter = 3.0;
    shape.segments = 1024;
    const scene::Scene scene = sceneOf(makeParaboloid(shape), mirror());
    const EmbreeScene embree(scene);
    for (double r = 0.05; r < 1.4; r += 0.11) {
        for (const double turn : {0.1, 1.7, 4.4}) {
            const PathSegment segment =
                segmentAfter(embree, 1, {r * std::cos(turn), 5.0, r * std::sin(turn)}, {0, -1, 0});
            // Facets lie up to (2π r/1024)²/8r = 7e-6 m inside of the surface; the normal between
            // vertices is off by less than 1e-5.
            EXPECT_LT(segment.distanceFrom({0.0, shape.focalLength, 0.0}), 3e-5) << "r = " << r;
        }
    }
}

}  // namespace
}  // namespace kaustik::reference
