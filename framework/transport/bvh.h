// SPDX-License-Identifier: MIT
// A bounding volume hierarchy over the triangles of a scene, four children a node, whose bounds are
// bytes on a grid of the node's own (wide nodes: Wald, Benthin and Boulos 2008, "Getting Rid of
// Packets"; bytes: Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on GPUs
// Through Compressed Wide BVHs"). Steps of that grid are powers of two, so that a bound is the same
// number wherever it is unpacked, and never inside of what it bounds. C++ and GLSL both read this
// file.
#pragma once

#ifdef __cplusplus
#include <bit>
#include <cmath>
#include <glm/glm.hpp>
namespace kaustik::transport {
using glm::uvec4;
using glm::vec3;
using std::ceil;
using std::floor;
using uint = unsigned int;
#define KAUSTIK_INLINE [[nodiscard]] inline
#define KAUSTIK_FLOAT_BITS std::bit_cast<uint>
#define KAUSTIK_BITS_FLOAT std::bit_cast<float>
#else
#define KAUSTIK_INLINE
#define KAUSTIK_FLOAT_BITS floatBitsToUint
#define KAUSTIK_BITS_FLOAT uintBitsToFloat
#endif

const uint kBvhWidth = 4u;
const uint kBvhNone = 0xffffffffu;  // a child that is not there
// A child that is a leaf: this bit, in the three bits below it its triangles less one, in the
// others the first of them. Any other child is the number of a node.
const uint kBvhLeaf = 0x80000000u;
const uint kBvhLeafShift = 28u;
const uint kBvhLeafMost = 4u;  // triangles in a leaf

// 64 bytes (std430).
struct BvhNode {
    vec3 origin;     // the lower corner of its bounds, m
    uint exponents;  // by the byte, for x, y and z: 2^(byte - 127) m is a step
    uvec4 children;
    uvec4 lower;  // x, y, z: steps from the origin along each axis, a byte a child
    uvec4 upper;
};

// A triangle of the hierarchy, in its order (std430).
struct BvhSource {
    uint material;  // index + 1
    uint object;
    uint triangle;  // of the object
    uint isMoving;  // its corners are made anew in each frame
};

KAUSTIK_INLINE uint bvhLeafCount(uint child) {
    return ((child >> kBvhLeafShift) & 7u) + 1u;
}
KAUSTIK_INLINE uint bvhLeafFirst(uint child) {
    return child & 0x0fffffffu;
}
KAUSTIK_INLINE uint bvhByte(uint word, uint child) {
    return (word >> (8u * child)) & 0xffu;
}

// The exponent of steps of which 255 cover `extent`.
KAUSTIK_INLINE uint bvhExponent(float extent) {
    uint bits = KAUSTIK_FLOAT_BITS(extent * (1.00001f / 255.0f));
    uint exponent = (bits >> 23u) + 1u;
    return exponent < 254u ? exponent : 254u;
}
KAUSTIK_INLINE float bvhStep(uint exponent) {
    return KAUSTIK_BITS_FLOAT(exponent << 23u);
}
// The steps from `origin` that lie at `value` or below, and at it or above.
KAUSTIK_INLINE uint bvhLowerSteps(float value, float origin, float step) {
    float steps = floor((value - origin) / step);
    steps = steps > 0.0f ? (steps < 255.0f ? steps : 255.0f) : 0.0f;
    while (steps > 0.0f && origin + steps * step > value)
        steps -= 1.0f;
    return uint(steps);
}
KAUSTIK_INLINE uint bvhUpperSteps(float value, float origin, float step) {
    float steps = ceil((value - origin) / step);
    steps = steps > 0.0f ? (steps < 255.0f ? steps : 255.0f) : 0.0f;
    while (steps < 255.0f && origin + steps * step < value)
        steps += 1.0f;
    return uint(steps);
}

// A node of children with these bounds, m; of one that is not there they do not matter.
KAUSTIK_INLINE BvhNode bvhNodeOf(uvec4 children, const vec3 lower[4], const vec3 upper[4]) {
    BvhNode node;
    node.children = children;
    node.origin = vec3(0.0f);
    node.exponents = 0u;
    node.lower = uvec4(0u);
    node.upper = uvec4(0u);
    for (int axis = 0; axis < 3; ++axis) {
        float first = 3.4e38f;
        float last = -3.4e38f;
        for (int i = 0; i < 4; ++i) {
            if (children[i] == kBvhNone) continue;
            first = lower[i][axis] < first ? lower[i][axis] : first;
            last = upper[i][axis] > last ? upper[i][axis] : last;
        }
        uint exponent = bvhExponent(last - first);
        float step = bvhStep(exponent);
        node.origin[axis] = first;
        node.exponents |= exponent << uint(8 * axis);
        for (int i = 0; i < 4; ++i) {
            if (children[i] == kBvhNone) continue;
            uint shift = uint(8 * i);
            node.lower[axis] |= bvhLowerSteps(lower[i][axis], first, step) << shift;
            node.upper[axis] |= bvhUpperSteps(upper[i][axis], first, step) << shift;
        }
    }
    return node;
}

// Its bounds: of child `child` the lower or the upper corner, m.
KAUSTIK_INLINE vec3 bvhCorner(vec3 origin, uint exponents, uvec4 steps, uint child) {
    return origin + vec3(float(bvhByte(steps.x, child)) * bvhStep(bvhByte(exponents, 0u)),
                         float(bvhByte(steps.y, child)) * bvhStep(bvhByte(exponents, 1u)),
                         float(bvhByte(steps.z, child)) * bvhStep(bvhByte(exponents, 2u)));
}

#undef KAUSTIK_INLINE
#undef KAUSTIK_FLOAT_BITS
#undef KAUSTIK_BITS_FLOAT
#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
