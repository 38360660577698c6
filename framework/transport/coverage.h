// SPDX-License-Identifier: MIT
// How much of a pixel a triangle covers, exactly, by the integral of x dy around it (Green): of any
// size, down to one far smaller than a pixel, and of either orientation. C++ and GLSL both read
// this file.
#pragma once

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace kaustik::transport {
using glm::abs;
using glm::clamp;
using glm::inversesqrt;
using glm::max;
using glm::min;
using glm::sqrt;
using glm::vec2;
using glm::vec3;
#define KAUSTIK_INLINE [[nodiscard]] inline
#else
#define KAUSTIK_INLINE
#endif

// A triangle thinner than this, px, is taken to be as thin: along it, it is the same.
const float kMinHeight = 1.0f / 64.0f;

struct ScreenTriangle {
    vec2 a, b, c;  // px, from the corner of some pixel
    vec3 slopes;   // x by y of its sides a b, b c, c a; 0 of a level one
    float area;    // px², with its orientation's sign; never 0
};

// Its x by its y.
KAUSTIK_INLINE float slopeOf(vec2 side) {
    return side.y != 0.0f ? side.x / side.y : 0.0f;
}

KAUSTIK_INLINE ScreenTriangle triangleOf(vec2 a, vec2 b, vec2 c) {
    vec2 ab = b - a;
    vec2 bc = c - b;
    vec2 ca = a - c;
    vec3 sides = vec3(dot(ab, ab), dot(bc, bc), dot(ca, ca));
    float longest = max(sides.x, max(sides.y, sides.z));
    float twice = ab.x * bc.y - ab.y * bc.x;
    // The corner across the longest side is moved away from it: what the triangle holds between two
    // lines across that side stays the same share of it.
    float sign = twice < 0.0f ? -1.0f : 1.0f;
    if (abs(twice) < kMinHeight * sqrt(longest)) {
        if (longest < kMinHeight * kMinHeight) {
            // A point; as large as what is resolved.
            vec2 middle = (a + b + c) / 3.0f;
            a = middle + kMinHeight * vec2(-1.0f, -0.5f);
            b = middle + kMinHeight * vec2(1.0f, -0.5f);
            c = middle + kMinHeight * vec2(0.0f, 1.0f);
            sign = 1.0f;
        } else {
            float lift = (sign * kMinHeight - twice * inversesqrt(longest)) * inversesqrt(longest);
            if (longest == sides.x) {
                c += lift * vec2(-ab.y, ab.x);
            } else if (longest == sides.y) {
                a += lift * vec2(-bc.y, bc.x);
            } else {
                b += lift * vec2(-ca.y, ca.x);
            }
        }
        twice = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
    }
    if (twice == 0.0f) twice = sign * kMinHeight * kMinHeight;
    ScreenTriangle made;
    made.a = a;
    made.b = b;
    made.c = c;
    made.slopes = vec3(slopeOf(b - a), slopeOf(c - b), slopeOf(a - c));
    made.area = 0.5f * twice;
    return made;
}

// ∫ clamp(x, 0, 1) dx from 0.
KAUSTIK_INLINE float clampedIntegral(float x) {
    float inside = clamp(x, 0.0f, 1.0f);
    return 0.5f * inside * inside + max(x - 1.0f, 0.0f);
}

// ∫ clamp(x, 0, 1) dy along a side within the pixel [0, 1]².
KAUSTIK_INLINE float sideCoverage(vec2 from, vec2 to, float slope) {
    float low = clamp(from.y, 0.0f, 1.0f);
    float high = clamp(to.y, 0.0f, 1.0f);
    float rise = high - low;
    if (rise == 0.0f) return 0.0f;
#ifdef __cplusplus
    // What follows would find the same, later.
    if (max(from.x, to.x) <= 0.0f) return 0.0f;
    if (min(from.x, to.x) >= 1.0f) return rise;
#endif
    float first = from.x + (low - from.y) * slope;
    float last = from.x + (high - from.y) * slope;
    float run = last - first;
    float mean = abs(run) < 1e-3f ? clamp(0.5f * (first + last), 0.0f, 1.0f)
                                  : (clampedIntegral(last) - clampedIntegral(first)) / run;
    return rise * mean;
}

// Of a square with this lower left corner, as a share of it; not below 0. `perSide`: 1 by its side,
// 1/px.
KAUSTIK_INLINE float coverageOf(ScreenTriangle triangle, vec2 corner, float perSide) {
    vec2 a = perSide * (triangle.a - corner);
    vec2 b = perSide * (triangle.b - corner);
    vec2 c = perSide * (triangle.c - corner);
    float sum = sideCoverage(a, b, triangle.slopes.x) + sideCoverage(b, c, triangle.slopes.y) +
                sideCoverage(c, a, triangle.slopes.z);
    return max(triangle.area < 0.0f ? -sum : sum, 0.0f);
}

// `span`, the least and the largest x, and what a side has between two heights.
KAUSTIK_INLINE vec2 spanWith(vec2 span, vec2 from, vec2 to, vec2 heights) {
    vec2 bottom = from.y < to.y ? from : to;
    vec2 top = from.y < to.y ? to : from;
    if (top.y < heights.x || bottom.y > heights.y) return span;
    float rise = top.y - bottom.y;
    vec2 at = rise > 0.0f ? clamp((heights - bottom.y) / rise, 0.0f, 1.0f) : vec2(0.0f, 1.0f);
    vec2 x = bottom.x + at * (top.x - bottom.x);
    return vec2(min(span.x, min(x.x, x.y)), max(span.y, max(x.x, x.y)));
}
KAUSTIK_INLINE vec2 spanWith(vec2 span, ScreenTriangle triangle, vec2 heights) {
    span = spanWith(span, triangle.a, triangle.b, heights);
    span = spanWith(span, triangle.b, triangle.c, heights);
    return spanWith(span, triangle.c, triangle.a, heights);
}

#undef KAUSTIK_INLINE
#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
