// SPDX-License-Identifier: MIT
// What bounds a volume, of meshes as others make them, and which way their triangles face.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "framework/scene/meshes/mesh_checks.h"
#include "framework/scene/meshes/orientation.h"
#include "framework/scene/meshes/winding_number.h"
#include "framework/scene/shapes/height_field.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene::test {
namespace {

bool hasInside(const Mesh& mesh) {
    return boundsVolume(meanWindingBehind(mesh));
}

// A sheet of quads over the unit square that `place` bends; up is where y is.
template <class Place>
Mesh bentSheet(unsigned cells, Place&& place) {
    Mesh mesh;
    for (unsigned j = 0; j <= cells; ++j) {
        for (unsigned i = 0; i <= cells; ++i)
            mesh.positions.push_back(glm::vec3(place(double(i) / cells, double(j) / cells)));
    }
    for (unsigned j = 0; j < cells; ++j) {
        for (unsigned i = 0; i < cells; ++i) {
            const unsigned corner = j * (cells + 1) + i;
            mesh.triangles.push_back({corner, corner + cells + 1, corner + cells + 2});
            mesh.triangles.push_back({corner, corner + cells + 2, corner + 1});
        }
    }
    return mesh;
}

// A crest that hangs over what it is about to fall on (Gerstner's wave, too high).
Mesh breakingWave() {
    return bentSheet(48, [](double u, double v) {
        const double angle = 2.0 * glm::two_pi<double>() * u;
        return glm::dvec3(u + 0.16 * std::sin(angle), 0.14 * std::cos(angle), v);
    });
}

Mesh withSlivers(Mesh mesh) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    for (const float side : {4e-6f, -4e-6f}) {
        mesh.positions.insert(mesh.positions.end(),
                              {{0.1f, 0.0f, 0.1f}, {0.1f, 0.0f, 0.10001f}, {0.1f, side, 0.1f}});
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first + 3, first + 4, first + 5});
    return mesh;
}

// Of the triangles, those of whose corners `isKept` says so.
template <class IsKept>
Mesh partOf(Mesh mesh, IsKept&& isKept) {
    std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
        return !isKept(mesh.positions[t.x]) || !isKept(mesh.positions[t.y]) ||
               !isKept(mesh.positions[t.z]);
    });
    return mesh;
}

Mesh ball(unsigned segments = 32) {
    return makeSphere({1.0, segments});
}

Mesh halfBall() {
    return partOf(ball(), [](const glm::vec3& p) { return p.y > -1e-4f; });
}

// A bottle: wide below, a neck above, a bottom and a stopper where asked for.
Mesh bottle(bool hasBottom, bool hasStopper) {
    return partOf(ball(48), [&](const glm::vec3& p) {
        return (hasBottom || p.y > -0.85f) && (hasStopper || p.y < 0.95f);
    });
}

// Two half balls that a gap parts, and another that is stuck through their wall: a teapot's body,
// lid and handle, as their patches come.
Mesh teapot() {
    Mesh mesh;
    const auto add = [&](const Mesh& part, const glm::vec3& scale, const glm::vec3& at) {
        const auto first = static_cast<unsigned>(mesh.positions.size());
        for (const glm::vec3& position : part.positions)
            mesh.positions.push_back(position * scale + at);
        for (const glm::uvec3& triangle : part.triangles) {
            const bool isMirrored = scale.x * scale.y * scale.z < 0.0f;
            const glm::uvec3 turned(triangle.x, triangle.z, triangle.y);
            mesh.triangles.push_back((isMirrored ? turned : triangle) + first);
        }
    };
    add(halfBall(), {1, 1, 1}, {0, 0.005f, 0});
    add(halfBall(), {1, -1, 1}, {0, -0.005f, 0});
    add(halfBall(), {0.3f, 0.3f, 0.3f}, {0, 0.97f, 0});
    return mesh;
}

TEST(WindingNumber, IsOneInABallAndNoneOutside) {
    for (const glm::dvec3& inside : {glm::dvec3(0.0), {0.5, 0.3, -0.6}, {0.0, 0.97, 0.0}})
        EXPECT_NEAR(windingNumber(ball(), inside), 1.0, 2e-3);
    for (const glm::dvec3& outside : {glm::dvec3(0, 1.03, 0), {5, 5, 5}})
        EXPECT_NEAR(windingNumber(ball(), outside), 0.0, 2e-3);
}

// Six of them close a cube.
TEST(WindingNumber, OfASquareIsASixthFromHalfItsSide) {
    const Mesh square = makePlane({{1.0, 1.0}, {7, 7}});
    EXPECT_NEAR(windingNumber(square, {0, -0.5, 0}), 1.0 / 6.0, 1e-3);
    EXPECT_NEAR(windingNumber(square, {0, 0.5, 0}), -1.0 / 6.0, 1e-3);
}

TEST(MeanWindingBehind, IsHalfOfSheetsAndWholeOfBodies) {
    EXPECT_NEAR(meanWindingBehind(makePlane({{3.0, 2.0}, {5, 9}})), 0.5, 1e-9);
    EXPECT_NEAR(meanWindingBehind(ball()), 1.0, 0.01);
    EXPECT_NEAR(meanWindingBehind(makeBox({})), 1.0, 1e-3);
    EXPECT_NEAR(meanWindingBehind(makeBox({glm::dvec3(1.0), true, {}})), 0.0, 1e-3);
    // All less what the other half would take of the sight of points of this one: by quadrature
    // of dA / 2r over 4 pi, r from point to point.
    EXPECT_NEAR(meanWindingBehind(halfBall()), 0.8187, 0.015);
    EXPECT_EQ(meanWindingBehind({}), 0.5);
}

TEST(MeanWindingBehind, CountsSliversByTheirArea) {
    EXPECT_NEAR(meanWindingBehind(withSlivers(makePlane({{2.0, 2.0}, {16, 16}}))), 0.5, 1e-6);
}

TEST(BoundsVolume, SaysWhatHasAnInside) {
    EXPECT_FALSE(hasInside(makePlane({})));
    EXPECT_FALSE(hasInside(withSlivers(makePlane({{2.0, 2.0}, {16, 16}}))));
    EXPECT_FALSE(hasInside(breakingWave()));
    EXPECT_FALSE(hasInside(bentSheet(8, [](double u, double v) {  // folded in the middle
        return glm::dvec3(std::abs(u - 0.5) * 0.7, (u - 0.5) * 0.7, v);
    })));
    EXPECT_TRUE(hasInside(halfBall()));
    EXPECT_TRUE(hasInside(teapot()));
    EXPECT_TRUE(hasInside(bottle(false, true)));
    EXPECT_TRUE(hasInside(bottle(false, false)));
    EXPECT_TRUE(
        hasInside(makeBox({glm::dvec3(2.0), true, {false, false, false, false, false, true}})));
}

TEST(TurnsBack, IsWhatALineCrossesTwice) {
    EXPECT_TRUE(turnsBack(breakingWave()));
    EXPECT_FALSE(turnsBack(makePlane({})));
    EXPECT_FALSE(turnsBack(withSlivers(makePlane({{2.0, 2.0}, {16, 16}}))));
}

TEST(OrientTriangles, MakesNeighboursFaceTheSameWay) {
    Mesh mixed = ball();
    for (std::size_t i = 0; i < mixed.triangles.size(); i += 3)
        std::swap(mixed.triangles[i].y, mixed.triangles[i].z);
    const std::size_t against = (mixed.triangles.size() + 2) / 3;
    EXPECT_FALSE(isClosed(mixed));
    const Orientation done = orientTriangles(mixed);
    EXPECT_EQ(done.turned, against);
    EXPECT_EQ(done.unorientable, 0u);
    EXPECT_TRUE(isClosed(mixed));
    EXPECT_EQ(mixed.triangles, ball().triangles);
}

TEST(OrientTriangles, LeavesAloneWhatFacesOneWayOrHasOneSide) {
    Mesh inward = makeBox({glm::dvec3(1.0), true, {}});
    const std::vector<glm::uvec3> before = inward.triangles;
    EXPECT_EQ(orientTriangles(inward).turned, 0u);
    EXPECT_EQ(inward.triangles, before);

    Mesh moebius;
    constexpr unsigned kSteps = 24;
    for (unsigned i = 0; i < kSteps; ++i) {
        const double around = glm::two_pi<double>() * i / kSteps;
        for (const double across : {-0.2, 0.2}) {
            const double radius = 1.0 + across * std::cos(0.5 * around);
            moebius.positions.push_back(glm::vec3(radius * std::cos(around),
                                                  across * std::sin(0.5 * around),
                                                  radius * std::sin(around)));
        }
    }
    for (unsigned i = 0; i < kSteps; ++i) {
        const bool isLast = i + 1 == kSteps;
        const unsigned a = 2 * i;
        const unsigned b = 2 * i + 1;
        const unsigned c = isLast ? 1 : a + 2;
        const unsigned d = isLast ? 0 : b + 2;
        moebius.triangles.push_back({a, c, b});
        moebius.triangles.push_back({b, c, d});
    }
    const Orientation done = orientTriangles(moebius);
    EXPECT_EQ(done.turned, 0u);
    EXPECT_EQ(done.unorientable, moebius.triangles.size());
}

}  // namespace
}  // namespace kaustik::scene::test
