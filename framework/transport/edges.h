// SPDX-License-Identifier: MIT
// Pixels in which a surface ends: the places in each that are looked at, and how these are kept
// (techniques/reconstruct/edge_samples.h). C++ and GLSL both read this file.
#pragma once

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace kaustik::transport {
using glm::vec2;
#define KAUSTIK_INLINE [[nodiscard]] inline
#else
#define KAUSTIK_INLINE
#endif

const int kEdgeSamples = 4;        // one in each quarter of a pixel
const int kEdgePixelsOfRow = 256;  // in a row of the samples' texture

// One in each of the pixel's quarters, from its corner: so that no two lie in one of four rows or
// columns, since an edge along these would show in all places of a side at once.
KAUSTIK_INLINE vec2 edgePlace(int sampled) {
    vec2 quarter = vec2(float(sampled & 1), float(sampled >> 1));
    return vec2(0.125f) + 0.5f * quarter + 0.25f * vec2(1.0f - quarter.y, quarter.x);
}

#undef KAUSTIK_INLINE
#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
