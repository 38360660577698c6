// SPDX-License-Identifier: MIT
// Unit vectors as two numbers in [-1, 1]: the octahedron |x| + |y| + |z| = 1, its lower half folded
// out. As exact as the floats that hold them. C++ and GLSL both read this file.
#pragma once

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace kaustik::transport {
using glm::abs;
using glm::normalize;
using glm::vec2;
using glm::vec3;
#define KAUSTIK_INLINE [[nodiscard]] inline
#else
#define KAUSTIK_INLINE
#endif

KAUSTIK_INLINE vec2 signOf(vec2 v) {
    return vec2(v.x >= 0.0f ? 1.0f : -1.0f, v.y >= 0.0f ? 1.0f : -1.0f);
}
// Of the octahedron's lower half to its outside, and back.
KAUSTIK_INLINE vec2 foldedOver(vec2 v) {
    return (1.0f - abs(vec2(v.y, v.x))) * signOf(v);
}

KAUSTIK_INLINE vec2 packUnitVector(vec3 unit) {
    vec3 n = unit / (abs(unit.x) + abs(unit.y) + abs(unit.z));
    return n.z >= 0.0f ? vec2(n.x, n.y) : foldedOver(vec2(n.x, n.y));
}

KAUSTIK_INLINE vec3 unpackUnitVector(vec2 folded) {
    float height = 1.0f - abs(folded.x) - abs(folded.y);
    return normalize(vec3(height < 0.0f ? foldedOver(folded) : folded, height));
}

#undef KAUSTIK_INLINE
#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
