// SPDX-License-Identifier: MIT
// How much of a pixel a triangle covers (framework/transport/coverage.h), against a polygon
// that is clipped to the pixel in double precision: as a shader finds it, and as the processor
// does.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "framework/numerics/probe.h"
#include "framework/transport/coverage.h"
#include "tests/gpu/fixture.h"

namespace kaustik::test {
namespace {

using glm::dvec2;
using glm::vec2;
using glm::vec4;
using transport::kMinHeight;

using Corners = std::array<vec2, 3>;

// Area, with its sign, of what lies in the pixel with this lower left corner (Sutherland, Hodgman).
double clippedArea(const Corners& corners, const dvec2& pixel) {
    std::vector<dvec2> polygon;
    for (const vec2& corner : corners)
        polygon.push_back(dvec2(corner) - pixel);
    for (int side = 0; side < 4; ++side) {
        const int axis = side / 2;
        const auto inside = [&](const dvec2& p) { return side % 2 == 0 ? p[axis] : 1.0 - p[axis]; };
        std::vector<dvec2> clipped;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const dvec2& from = polygon[i];
            const dvec2& to = polygon[(i + 1) % polygon.size()];
            const double a = inside(from);
            const double b = inside(to);
            if (a >= 0.0) clipped.push_back(from);
            if ((a >= 0.0) != (b >= 0.0)) clipped.push_back(from + a / (a - b) * (to - from));
        }
        polygon = clipped;
    }
    double area = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec2& a = polygon[i];
        const dvec2& b = polygon[(i + 1) % polygon.size()];
        area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    return area;
}

double areaOf(const Corners& t) {
    const dvec2 ab = dvec2(t[1]) - dvec2(t[0]);
    const dvec2 ac = dvec2(t[2]) - dvec2(t[0]);
    return 0.5 * (ab.x * ac.y - ab.y * ac.x);
}

double longestSide(const Corners& t) {
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        longest = std::max(longest, glm::length(dvec2(t[i]) - dvec2(t[(i + 1) % 3])));
    return longest;
}

struct Coverage {
    double worst = 0.0;       // of a pixel, px²
    double between = 0.0;     // what a shader finds of a pixel and what the processor does, px²
    double worstSum = 0.0;    // of all pixels of a triangle, as a share of its area
    double farthest = 0.0;    // that a corner was moved, px
    std::size_t moved = 0;    // triangles
    std::size_t covered = 0;  // pixels
};

// Over all pixels around each triangle.
Coverage coverageOf(const std::vector<Corners>& triangles) {
    std::vector<vec4> inputs;
    std::vector<std::size_t> triangleOfCase;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Corners& t = triangles[i];
        const vec2 low = glm::floor(glm::min(t[0], glm::min(t[1], t[2])) - 0.1f);
        const vec2 high = glm::floor(glm::max(t[0], glm::max(t[1], t[2])) + 0.1f);
        for (float y = low.y; y <= high.y; y += 1.0f) {
            for (float x = low.x; x <= high.x; x += 1.0f) {
                inputs.emplace_back(t[0], t[1]);
                inputs.emplace_back(t[2], vec2(x, y));
                triangleOfCase.push_back(i);
            }
        }
    }
    const std::vector<vec4> outputs =
        numerics::probe(context(), "tests/gpu/shaders/coverage.comp", inputs,
                        static_cast<int>(triangleOfCase.size()), 3);
    Coverage found;
    std::vector<double> sums(triangles.size(), 0.0);
    std::vector<double> areas(triangles.size(), 0.0);
    for (std::size_t i = 0; i < triangleOfCase.size(); ++i) {
        const std::size_t triangle = triangleOfCase[i];
        const vec4& first = outputs[3 * i];
        const Corners taken = {vec2(outputs[3 * i + 1]),
                               vec2(outputs[3 * i + 1].z, outputs[3 * i + 1].w),
                               vec2(outputs[3 * i + 2])};
        double moved = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
            moved = std::max(moved, double{glm::length(taken[k] - triangles[triangle][k])});
        found.farthest = std::max(found.farthest, moved);
        const vec2 corner(inputs[2 * i + 1].z, inputs[2 * i + 1].w);
        const double exact = std::abs(clippedArea(taken, dvec2(corner)));
        found.worst = std::max(found.worst, std::abs(double{first.x} - exact));
        const Corners& own = triangles[triangle];
        const float byProcessor =
            transport::coverageOf(transport::triangleOf(own[0], own[1], own[2]), corner, 1.0f);
        found.between = std::max(found.between, std::abs(double{first.x} - double{byProcessor}));
        found.covered += exact > 0.0 ? 1u : 0u;
        if (sums[triangle] == 0.0 && areas[triangle] == 0.0 && moved > 0.0) ++found.moved;
        sums[triangle] += double{first.x};
        areas[triangle] = double{first.y};
        // Its orientation is its own.
        if (moved == 0.0) {
            EXPECT_GT(double{first.y} * areaOf(triangles[triangle]), 0.0);
        }
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const double area = std::abs(areas[i]);
        EXPECT_GT(area, 0.0);
        found.worstSum = std::max(found.worstSum, std::abs(sums[i] / area - 1.0));
    }
    return found;
}

class Coverages : public ::testing::Test {
  protected:
    vec2 within(float size) {
        std::uniform_real_distribution<float> at(-0.5f * size, 0.5f * size);
        return {at(random_), at(random_)};
    }
    std::mt19937 random_{7};
};

TEST_F(Coverages, AreExactWhateverTheSizeAndTheOrientation) {
    std::vector<Corners> triangles;
    for (int i = 0; i < 1500; ++i) {
        // From a tenth of a pixel to 20.
        const float size = 0.1f * std::pow(200.0f, static_cast<float>(i) / 1500.0f);
        const vec2 middle = within(10.0f);
        triangles.push_back({middle + within(size), middle + within(size), middle + within(size)});
        const Corners& t = triangles.back();
        // Those that are thinner than what is resolved have a test of their own.
        if (2.0 * std::abs(areaOf(t)) < 1.5 * kMinHeight * longestSide(t)) triangles.pop_back();
    }
    ASSERT_GT(triangles.size(), 1000u);
    const Coverage found = coverageOf(triangles);
    RecordProperty("worst_e9", static_cast<int>(1e9 * found.worst));
    EXPECT_GT(found.covered, 10000u);
    EXPECT_EQ(found.moved, 0u);
    // Corners lie some 1e-6 px next to themselves in float; a side is at most 1.4 px long in a
    // pixel.
    EXPECT_LT(found.worst, 2e-5);
    EXPECT_LT(found.between, 1e-5);
    EXPECT_LT(found.worstSum, 1e-3);
}

TEST_F(Coverages, OfHugeTrianglesAddUp) {
    std::vector<Corners> triangles;
    for (int i = 0; i < 6; ++i)
        triangles.push_back({within(400.0f), within(400.0f), within(400.0f)});
    const Coverage found = coverageOf(triangles);
    EXPECT_GT(found.covered, 20000u);
    // The same at 400 px.
    EXPECT_LT(found.worst, 1e-4);
    EXPECT_LT(found.between, 5e-5);
    EXPECT_LT(found.worstSum, 1e-5);
}

TEST_F(Coverages, OfSliversAndPointsAddUpToWhatTheyAreTakenAs) {
    std::vector<Corners> triangles;
    for (int i = 0; i < 500; ++i) {
        const vec2 middle = within(10.0f);
        const vec2 along = within(12.0f);
        const vec2 off = within(0.01f);
        triangles.push_back({middle, middle + along, middle + 0.3f * along + off});
        triangles.push_back({middle, middle + along, middle + along});
        triangles.push_back({middle, middle + 1e-4f * along, middle + 2e-4f * off});
        // Sides along the pixels' own.
        triangles.push_back({glm::round(middle), glm::round(middle) + vec2(3.0f, 0.0f),
                             glm::round(middle) + vec2(1.0f, 0.0f)});
    }
    const Coverage found = coverageOf(triangles);
    EXPECT_GT(found.moved, 1000u);
    // No corner leaves its place by more than what is resolved, twice that of a point's.
    EXPECT_LT(found.farthest, 2.0 * kMinHeight);
    EXPECT_LT(found.worst, 1e-5);
    EXPECT_LT(found.between, 1e-5);
    EXPECT_LT(found.worstSum, 5e-3);
}

}  // namespace
}  // namespace kaustik::test
