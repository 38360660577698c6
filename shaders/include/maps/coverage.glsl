// SPDX-License-Identifier: MIT
// How much of a pixel a triangle covers, exactly, by the integral of x dy around it (Green): of any
// size, down to one far smaller than a pixel, and of either orientation.

// A triangle thinner than this, px, is taken to be as thin: along it, it is the same.
const float kMinHeight = 1.0 / 64.0;

struct Triangle {
    vec2 a, b, c;  // px, from the corner of some pixel
    vec3 slopes;   // x by y of its sides a b, b c, c a; 0 of a level one
    float area;    // px², with its orientation's sign; never 0
};

// Its x by its y.
float slopeOf(vec2 side) {
    return side.y != 0.0 ? side.x / side.y : 0.0;
}

Triangle triangleOf(vec2 a, vec2 b, vec2 c) {
    vec2 ab = b - a;
    vec2 bc = c - b;
    vec2 ca = a - c;
    vec3 sides = vec3(dot(ab, ab), dot(bc, bc), dot(ca, ca));
    float longest = max(sides.x, max(sides.y, sides.z));
    float twice = ab.x * bc.y - ab.y * bc.x;
    // The corner across the longest side is moved away from it: what the triangle holds between two
    // lines across that side stays the same share of it.
    float sign = twice < 0.0 ? -1.0 : 1.0;
    if (abs(twice) < kMinHeight * sqrt(longest)) {
        if (longest < kMinHeight * kMinHeight) {
            // A point; as large as what is resolved.
            vec2 middle = (a + b + c) / 3.0;
            a = middle + kMinHeight * vec2(-1.0, -0.5);
            b = middle + kMinHeight * vec2(1.0, -0.5);
            c = middle + kMinHeight * vec2(0.0, 1.0);
            sign = 1.0;
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
    if (twice == 0.0) twice = sign * kMinHeight * kMinHeight;
    return Triangle(a, b, c, vec3(slopeOf(b - a), slopeOf(c - b), slopeOf(a - c)), 0.5 * twice);
}

// ∫ clamp(x, 0, 1) dx from 0.
float clampedIntegral(float x) {
    float inside = clamp(x, 0.0, 1.0);
    return 0.5 * inside * inside + max(x - 1.0, 0.0);
}

// ∫ clamp(x, 0, 1) dy along a side within the pixel [0, 1]².
float sideCoverage(vec2 from, vec2 to, float slope) {
    float low = clamp(from.y, 0.0, 1.0);
    float high = clamp(to.y, 0.0, 1.0);
    float rise = high - low;
    if (rise == 0.0) return 0.0;
    float first = from.x + (low - from.y) * slope;
    float last = from.x + (high - from.y) * slope;
    float run = last - first;
    float mean = abs(run) < 1e-3 ? clamp(0.5 * (first + last), 0.0, 1.0)
                                 : (clampedIntegral(last) - clampedIntegral(first)) / run;
    return rise * mean;
}

// Of the pixel with this lower left corner, px²; not below 0.
float coverageOf(Triangle triangle, vec2 corner) {
    vec2 a = triangle.a - corner;
    vec2 b = triangle.b - corner;
    vec2 c = triangle.c - corner;
    float sum = sideCoverage(a, b, triangle.slopes.x) + sideCoverage(b, c, triangle.slopes.y) +
                sideCoverage(c, a, triangle.slopes.z);
    return max(triangle.area < 0.0 ? -sum : sum, 0.0);
}

// Widens `span`, the least and the largest x, by what a side has between two heights.
void addToSpan(inout vec2 span, vec2 from, vec2 to, vec2 heights) {
    vec2 bottom = from.y < to.y ? from : to;
    vec2 top = from.y < to.y ? to : from;
    if (top.y < heights.x || bottom.y > heights.y) return;
    float rise = top.y - bottom.y;
    vec2 at = rise > 0.0 ? clamp((heights - bottom.y) / rise, 0.0, 1.0) : vec2(0.0, 1.0);
    vec2 x = bottom.x + at * (top.x - bottom.x);
    span = vec2(min(span.x, min(x.x, x.y)), max(span.y, max(x.x, x.y)));
}
void addToSpan(inout vec2 span, Triangle triangle, vec2 heights) {
    addToSpan(span, triangle.a, triangle.b, heights);
    addToSpan(span, triangle.b, triangle.c, heights);
    addToSpan(span, triangle.c, triangle.a, heights);
}
