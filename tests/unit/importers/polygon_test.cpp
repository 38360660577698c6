// SPDX-License-Identifier: MIT
// Polygons are cut into triangles that cover them once, in a time about in proportion to their
// size.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "framework/importers/polygon.h"

namespace kaustik::scene {
namespace {

using Corners = std::vector<glm::dvec3>;

glm::dvec3 areaOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return 0.5 * glm::cross(b - a, c - a);
}

glm::dvec3 areaOf(const Corners& corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += areaOf(corners[0], corners[i], corners[i + 1]);
    return sum;
}

// Whole, once and turning as the polygon does: n - 2 triangles that all face the polygon's way and
// whose areas add up to its own cannot overlap nor leave anything out.
void expectCovered(const Corners& corners) {
    const CutPolygon cut = cutPolygon(corners);
    EXPECT_TRUE(cut.isSimple);
    ASSERT_EQ(cut.triangles.size(), corners.size() - 2);
    const glm::dvec3 whole = areaOf(corners);
    const glm::dvec3 normal = glm::normalize(whole);
    double sum = 0.0;
    for (const glm::uvec3& t : cut.triangles) {
        const double area = glm::dot(areaOf(corners[t.x], corners[t.y], corners[t.z]), normal);
        EXPECT_GE(area, 0.0);
        sum += area;
    }
    // Rounding of a sum of as many doubles.
    EXPECT_NEAR(sum, glm::length(whole), 1e-12 * glm::length(whole) * double(corners.size()));
}

Corners circle(std::size_t n) {
    Corners corners;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * double(i) / double(n);
        corners.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    }
    return corners;
}

// Every other corner near the middle.
Corners star(std::size_t n) {
    Corners corners = circle(n);
    for (std::size_t i = 1; i < n; i += 2)
        corners[i] *= 0.05;
    return corners;
}

// Long teeth side by side on a thin back.
Corners comb(std::size_t n) {
    Corners corners;
    for (std::size_t i = 0; i < n - 2; ++i)
        corners.emplace_back(double(i), i % 2 == 0 ? 0.0 : double(n), 0.0);
    corners.emplace_back(double(n), -1.0, 0.0);
    corners.emplace_back(-1.0, -1.0, 0.0);
    // Counter-clockwise.
    return {corners.rbegin(), corners.rend()};
}

// A band that winds inwards: at each turn hundreds of corners are near, but round the bend.
Corners spiral(std::size_t n) {
    Corners corners;
    const std::size_t half = n / 2;
    const auto at = [&](std::size_t i, double inwards) {
        const double share = double(i) / double(half);
        const double angle = 40.0 * std::numbers::pi * share;
        return (1.0 - 0.9 * share - inwards) * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
    };
    for (std::size_t i = 0; i < half; ++i)
        corners.push_back(at(i, 0.0));
    for (std::size_t i = half; i > 0; --i)
        corners.push_back(at(i - 1, 0.01));
    return corners;
}

const std::vector<std::pair<const char*, std::function<Corners(std::size_t)>>> kShapes = {
    {"circle", circle}, {"star", star}, {"comb", comb}, {"spiral", spiral}};

TEST(Polygon, OfAnyShapeAndSizeIsCoveredOnce) {
    for (const auto& [name, shape] : kShapes) {
        for (const std::size_t n : {6u, 8u, 50u, 1000u}) {
            SCOPED_TRACE(std::string(name) + " of " + std::to_string(n));
            if (std::string(name) != "spiral" || n > 100) expectCovered(shape(n));
        }
    }
}

TEST(Polygon, MayLieInAnyPlaneAndTurnEitherWay) {
    for (const glm::dvec3& axis : {glm::dvec3(1, 2, 3), glm::dvec3(-3, 1, 0.5),
                                   glm::dvec3(0, -1, 0), glm::dvec3(0.1, 0.2, -4)}) {
        const glm::dvec3 u = glm::normalize(glm::cross(axis, glm::dvec3(0.3, 0.5, 0.9)));
        const glm::dvec3 v = glm::cross(glm::normalize(axis), u);
        Corners corners = star(40);
        for (glm::dvec3& corner : corners)
            corner = glm::dvec3(100.0) + corner.x * u + corner.y * v;
        expectCovered(corners);
        expectCovered({corners.rbegin(), corners.rend()});
    }
}

TEST(Polygon, OfFourCornersIsCutWhereItBendsInwards) {
    const Corners arrow{{0, 0, 0}, {2, -1, 0}, {0, 2, 0}, {-2, -1, 0}};
    const CutPolygon cut = cutPolygon(arrow);
    EXPECT_TRUE(cut.isSimple);
    EXPECT_EQ(cut.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
    for (std::size_t first = 0; first < 4; ++first) {
        Corners turned;
        for (std::size_t i = 0; i < 4; ++i)
            turned.push_back(arrow[(first + i) % 4]);
        expectCovered(turned);
    }
}

TEST(Polygon, WithCornersInALineIsCovered) {
    // A square with three more corners on each side.
    Corners square;
    const Corners corners{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    for (std::size_t side = 0; side < 4; ++side) {
        for (int step = 0; step < 4; ++step)
            square.push_back(glm::mix(corners[side], corners[(side + 1) % 4], 0.25 * step));
    }
    expectCovered(square);
}

TEST(Polygon, WithAHoleThatABridgeLeadsToIsCovered) {
    // Bridge corners are there twice.
    expectCovered({{0, 0, 0},
                   {4, 0, 0},
                   {4, 4, 0},
                   {0, 4, 0},
                   {0, 0, 0},
                   {1, 1, 0},
                   {1, 3, 0},
                   {3, 3, 0},
                   {3, 1, 0},
                   {1, 1, 0}});
}

TEST(Polygon, ThatCrossesItselfIsSaidToBeCutAllTheSame) {
    const Corners eight{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1.9, 0}, {-1, 1, 0}};
    const CutPolygon cut = cutPolygon(eight);
    EXPECT_EQ(cut.triangles.size(), 3u);
    EXPECT_FALSE(cut.isSimple);
    const Corners bowTie{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2.5, 0}};
    EXPECT_FALSE(cutPolygon(bowTie).isSimple);
}

TEST(Polygon, WithoutAnAreaOrWithoutNumbersIsStillCut) {
    EXPECT_EQ(cutPolygon(Corners(7, glm::dvec3(1.0))).triangles.size(), 5u);
    Corners line;
    for (int i = 0; i < 9; ++i)
        line.emplace_back(i, 2 * i, -i);
    EXPECT_EQ(cutPolygon(line).triangles.size(), 7u);
    Corners unknown = circle(9);
    unknown[4].x = std::nan("");
    EXPECT_EQ(cutPolygon(unknown).triangles.size(), 7u);
    EXPECT_FALSE(cutPolygon(unknown).isSimple);
}

// A wheel one way and a smaller one the other way round: all corners of the latter bend inwards.
Corners wheels(std::size_t n) {
    Corners corners = circle(n / 2);
    Corners inner = circle(n - n / 2);
    for (auto corner = inner.rbegin(); corner != inner.rend(); ++corner)
        corners.push_back(glm::dvec3(1.8, 0, 0) + 0.8 * *corner);
    return corners;
}

TEST(Polygon, TakesAboutFourTimesTheStepsForFourTimesTheCorners) {
    auto shapes = kShapes;
    shapes.emplace_back("wheels", wheels);
    for (const auto& [name, shape] : shapes) {
        SCOPED_TRACE(name);
        const std::size_t n = 10000;
        const auto few = double(cutPolygon(shape(n)).work);
        const auto many = double(cutPolygon(shape(4 * n)).work);
        // The tree is two levels deeper, of 11: 4.7 times the steps; a square law has 16 times.
        EXPECT_LT(many, 6.0 * few) << few << " and " << many << " steps";
        EXPECT_GE(few, double(n));
    }
}

}  // namespace
}  // namespace kaustik::scene
