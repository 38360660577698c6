// SPDX-License-Identifier: MIT
// Refraction by curved glass and water against closed forms (framework/numerics/README.md, "Closed
// forms"). Meshes with exact normals at their vertices stand for the curved surfaces: tolerances
// follow from their fineness.
#include <cmath>
#include <functional>
#include <numbers>

#include "framework/scene/shapes/height_field.h"
#include "tests/accuracy/path_fixture.h"

namespace kaustik::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kIndex = 1.5;

scene::Scene glassBall(double radius, unsigned segments) {
    scene::SphereShape shape;
    shape.radius = radius;
    shape.segments = segments;
    return sceneOf(makeSphere(shape), glass(kIndex));
}

TEST(Lens, BallLensCrossesTheAxisWhereSnellSays) {
    const double radius = 1.0;
    const scene::Scene scene = glassBall(radius, 1024);
    const EmbreeScene embree(scene);
    // Facets are h = 2π/1024 wide: h²/8 = 4.7e-6 R inside of the ball, the normal off by as much.
    const double tolerance = 6e-5;
    for (const double b : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        const PathSegment segment = segmentAfter(embree, 2, {b, 3.0, 0.013}, {0, -1, 0});
        const double height = std::hypot(b, 0.013);
        const double deviation =
            2.0 * (std::asin(height / radius) - std::asin(height / (kIndex * radius)));
        const double expected = height / std::sin(deviation);
        // Through the axis: distance from the y axis vanishes at -expected.
        EXPECT_LT(segment.distanceFrom({0.0, -expected, 0.0}), tolerance) << "b = " << b;
    }
    // The number of the table.
    const PathSegment half = segmentAfter(embree, 2, {0.5, 3.0, 1e-7}, {0, -1, 0});
    EXPECT_NEAR(-half.crossing(0, 0.0).y, 1.39157, 2e-4);
}

TEST(Lens, BallLensHasItsFocalLengthNearTheAxis) {
    const scene::Scene scene = glassBall(1.0, 1024);
    const EmbreeScene embree(scene);
    const double focalLength = kIndex / (2.0 * (kIndex - 1.0));
    const PathSegment segment = segmentAfter(embree, 2, {0.03, 3.0, 1e-7}, {0, -1, 0});
    // Spherical aberration at b = 0.03 R is b²·0.5 = 5e-4 R; the normal's 5e-6 act over b.
    EXPECT_NEAR(-segment.crossing(0, 0.0).y, focalLength, 2e-3);
}

// A surface of revolution about y from its profile.
scene::Scene revolved(const std::function<scene::ProfilePoint(double)>& profileAt, unsigned rings) {
    std::vector<scene::ProfilePoint> profile;
    for (unsigned j = 0; j <= rings; ++j)
        profile.push_back(profileAt(static_cast<double>(j) / rings));
    scene::MeshBuilder builder;
    builder.addRevolved(profile, 1024);
    return sceneOf(builder.finishSheet("surface"), glass(kIndex));
}

TEST(Lens, EllipsoidOfEccentricityOneOverNFocusesExactly) {
    const double a = 1.0;
    const double b = a * std::sqrt(1.0 - 1.0 / (kIndex * kIndex));
    // The upper half, from the vertex outwards.
    const scene::Scene scene = revolved(
        [&](double s) -> scene::ProfilePoint {
            const double angle = 0.49 * kPi * s;
            const glm::dvec2 normal(std::sin(angle) / b, std::cos(angle) / a);
            return {b * std::sin(angle), a * std::cos(angle), glm::normalize(normal)};
        },
        1024);
    const EmbreeScene embree(scene);
    const glm::dvec3 focus(0.0, -a / kIndex, 0.0);
    for (double r = 0.05; r < 0.9 * b; r += 0.07) {
        const PathSegment segment = segmentAfter(embree, 1, {r, 3.0, 0.21 * r}, {0, -1, 0});
        // Rings and sectors are at most 6e-3 wide: h²/8 = 5e-6 in position and normal.
        EXPECT_LT(segment.distanceFrom(focus), 3e-5) << "r = " << r;
    }
}

TEST(Lens, HyperboloidOfEccentricityNFocusesExactly) {
    const double a = 0.5;
    const double b = a * std::sqrt(kIndex * kIndex - 1.0);
    // The glass lies above; its lower face has its vertex at y = a and rises outwards.
    const scene::Scene scene = revolved(
        [&](double s) -> scene::ProfilePoint {
            const double r = 0.8 * (1.0 - s);
            const double y = a * std::sqrt(1.0 + r * r / (b * b));
            return {r, y, glm::normalize(glm::dvec2(r / (b * b), -y / (a * a)))};
        },
        1024);
    const EmbreeScene embree(scene);
    const glm::dvec3 focus(0.0, -kIndex * a, 0.0);
    for (double r = 0.05; r < 0.75; r += 0.07) {
        const PathSegment segment = segmentAfter(embree, 1, {r, 3.0, 0.21 * r}, {0, -1, 0});
        EXPECT_LT(segment.distanceFrom(focus), 3e-5) << "r = " << r;
    }
}

TEST(Lens, PlanoConvexLensHasItsFocusAtRadiusOverIndexMinusOne) {
    scene::LensShape shape;
    shape.topRadius = 0.0;
    shape.bottomRadius = 2.0;
    shape.diameter = 0.8;
    shape.centerThickness = 0.2;
    shape.segments = 1024;
    const scene::Scene scene = sceneOf(makeLens(shape), glass(kIndex));
    const EmbreeScene embree(scene);
    const double vertex = -0.5 * shape.centerThickness;
    for (const double h : {0.04, 0.1, 0.3}) {
        const PathSegment segment = segmentAfter(embree, 2, {h, 3.0, 1e-7}, {0, -1, 0});
        // Exact for this height: i inside, the sagitta, and Snell.
        const double inside = std::asin(h / shape.bottomRadius);
        const double outside = std::asin(kIndex * h / shape.bottomRadius);
        const double sagitta = shape.bottomRadius * (1.0 - std::cos(inside));
        const double back = h / std::tan(outside - inside) - sagitta;
        EXPECT_NEAR(vertex - segment.crossing(0, 0.0).y, back, 1e-4 * back) << "h = " << h;
    }
    const PathSegment nearAxis = segmentAfter(embree, 2, {0.04, 3.0, 1e-7}, {0, -1, 0});
    // The aberration at this height is (h/R)² n²/2 = 5e-4 of it.
    const double focalLength = shape.bottomRadius / (kIndex - 1.0);
    EXPECT_NEAR(vertex - nearAxis.crossing(0, 0.0).y, focalLength, 2e-3 * focalLength);
}

TEST(Lens, WaterWaveFocusesFirstBelowItsCrest) {
    const double amplitude = 0.01;
    const double wavelength = 1.0;
    const double k = 2.0 * kPi / wavelength;
    const double index = 1.333;
    scene::HeightField field;
    field.sizeMeters = {2.0f, 0.1f};
    field.cells = {2048, 2};
    field.waves = {{static_cast<float>(amplitude), static_cast<float>(wavelength), 0, 0, 0}};
    const scene::Scene scene = sceneOf(scene::makeHeightField(field, 0.0), glass(index));
    const EmbreeScene embree(scene);
    const PathSegment segment = segmentAfter(embree, 1, {0.0055, 1.0, 0.003}, {0, -1, 0});
    const double depth = amplitude - segment.crossing(0, 0.0).y;
    // Third-order terms are of the order (k x)² = 1.2e-3.
    EXPECT_NEAR(depth, index / ((index - 1.0) * amplitude * k * k), 2e-3 * depth);
}

TEST(Lens, GlassInsideWaterBendsByBothIndices) {
    scene::Scene scene = sceneOf(scene::makeBox({.size = {4.0, 1.0, 4.0}}), glass(1.333));
    addObject(scene, scene::makeBox({.size = {2.0, 0.4, 2.0}}), glass(kIndex));
    const EmbreeScene embree(scene);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, -1.0, 0.1));
    const double sine = std::hypot(direction.x, direction.z);
    const auto sineAfter = [&](int interactions) {
        const PathSegment segment = segmentAfter(embree, interactions, {-0.2, 2.0, 0.0}, direction);
        return std::hypot(segment.direction.x, segment.direction.z);
    };
    // Flat faces with exact normals: only the index is a float, 1e-7.
    EXPECT_NEAR(sineAfter(1), sine / 1.333, 1e-7);
    EXPECT_NEAR(sineAfter(2), sine / kIndex, 1e-7);
    EXPECT_NEAR(sineAfter(3), sine / 1.333, 1e-7);
    EXPECT_NEAR(sineAfter(4), sine, 1e-12);
}

TEST(Lens, PrismDeviatesLeastWhereItsFormulaSays) {
    scene::PrismShape shape;
    const scene::Scene scene = sceneOf(makePrism(shape), glass(kIndex));
    const EmbreeScene embree(scene);
    const double apex = shape.apexDegrees * kPi / 180.0;
    const double base = shape.height * std::tan(0.5 * apex);
    double minimum = kPi;
    for (double incidence = 0.70; incidence < 1.0; incidence += 1e-4) {
        // Aim at a third from the apex of the left face, from `incidence` below its normal.
        const glm::dvec3 target(-base / 3.0, shape.height / 2.0 - shape.height / 3.0, 0.0);
        const double normalAngle = kPi - 0.5 * apex;
        const double from = normalAngle + incidence;
        const glm::dvec3 direction(-std::cos(from), -std::sin(from), 0.0);
        const PathSegment segment = segmentAfter(embree, 2, target - direction, direction);
        minimum = std::min(minimum, std::acos(glm::dot(segment.direction, direction)));
    }
    // The deviation is flat at its minimum: steps of 1e-4 rad miss it by 1e-8; floats give 1e-7.
    EXPECT_NEAR(std::sin(0.5 * (apex + minimum)) / std::sin(0.5 * apex), kIndex, 1e-6);
}

TEST(Lens, PrimaryRainbowTurnsLeastWhereItsFormulaSays) {
    const double index = 1.333;
    scene::Scene scene = glassBall(1.0, 1024);
    scene.materials[0].ior = static_cast<float>(index);
    const EmbreeScene embree(scene);
    PathFilter everything;
    everything.splitInteractions = 3;
    const auto turnAt = [&](double b) {
        for (const PathSegment& segment :
             segmentsOf(embree, {b, 3.0, 1e-7}, {0, -1, 0}, everything)) {
            // In, one reflection inside, out: the only way out after three.
            const bool isOut = glm::dot(segment.origin, segment.direction) > 0.0;
            if (segment.interactions == 3 && isOut)
                return 2.0 * kPi - std::acos(glm::clamp(-segment.direction.y, -1.0, 1.0));
        }
        ADD_FAILURE();
        return 0.0;
    };
    double minimum = 2.0 * kPi;
    double minHeight = 0.0;
    for (double b = 0.80; b < 0.92; b += 2e-4) {
        const double turn = std::min(turnAt(b), 2.0 * kPi - turnAt(b));
        if (turn < minimum) {
            minimum = turn;
            minHeight = b;
        }
    }
    const double incidence = std::acos(std::sqrt((index * index - 1.0) / 3.0));
    const double refraction = std::asin(std::sin(incidence) / index);
    const double expected = kPi + 2.0 * incidence - 4.0 * refraction;
    // Three normals, each off by up to 4.7e-6, and a step of b that the minimum hardly feels.
    EXPECT_NEAR(minimum, expected, 6e-5);
    // The minimum is flat: an error of 2e-5 rad in the angle moves it by some 3e-3.
    EXPECT_NEAR(minHeight, std::sin(incidence), 6e-3);
}

}  // namespace
}  // namespace kaustik::reference
