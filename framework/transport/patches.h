// SPDX-License-Identifier: MIT
// Patches of receivers, four corners that light arrives between, as reconstruct.triangles hands
// them from shader to shader and to the processor, and what both take them to bring to what is
// seen. C++ and GLSL both read this file.
#pragma once

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace kaustik::transport {
using glm::abs;
using glm::dot;
using glm::max;
using glm::vec3;
using glm::vec4;
using uint = unsigned int;
#define KAUSTIK_INLINE [[nodiscard]] inline
#else
#define KAUSTIK_INLINE
#endif

// One that is made (std430).
struct PatchData {
    vec4 corners[4];  // around it; xyz, m; w: the density there
    vec4 normal;      // xyz; w: the share of the flux in the first of its triangles
    vec4 direction;   // xyz; w: its tolerance, m
    vec4 flux;        // rgb, W; w: bits, those below
};
const uint kPatchIsJoined = 1u;
const uint kPatchIsFromBehind = 2u;
const uint kPatchIsAlone = 4u;
const uint kPatchIsNone = 8u;  // nothing is to be covered: it is booked already

// Pixels of the rectangle around a patch, beyond which it is wide: more than a shader has one
// thread for, and, of a beam alone, for which squares of pixels are fine enough.
const int kMaxPixelsOfNarrow = 100;
const int kPixelBlockSide = 4;  // px, of those squares

// What the area of the middle's receiver may be of another's in its pixel: a surface that is seen
// edge-on has no end of it.
const float kMaxStored = 100.0f;

// A beam that grazes a plane by less than this sine tells nothing of how light falls on what turns
// away from it.
const float kMinLitSlant = 0.05f;

// Of its plane a triangle is taken for a line, and faces as the surface does, by these: twice its
// area by the square of its sides; a cosine.
const float kMinFlatness = 1e-3f;
const float kMinPlaneCosine = 0.5f;
// A triangle in space has at least this share of what it covers in the picture.
const float kMinOfCovered = 0.25f;
// Densities that differ by more are those of a fold, and say nothing of a triangle's middle.
const float kMaxDensityRatio = 4.0f;
// Where less than this is found of a patch, the rest lies beyond an edge.
const float kMinFound = 0.5f;

// How the surface lies, and from where light comes to it.
struct PatchSide {
    vec3 normal;
    vec3 direction;
    bool isFromBehind;  // to the back of a sheet
};

// How much of the light through a plane falls on what is seen with this normal: what turns away
// from the light has less by its cosine, unless that is known already, and what is turned off it
// none.
KAUSTIK_INLINE float litShare(vec3 seenNormal, vec3 plane, bool isShaded, PatchSide side) {
    float cosine = dot(seenNormal, side.direction) * (side.isFromBehind ? 1.0f : -1.0f);
    if (cosine <= 0.0f) return 0.0f;
    float slant = abs(dot(plane, side.direction));
    float least = max(kMinLitSlant - slant, 0.0f);
    return isShaded ? 1.0f : (cosine + least) / (slant + least);
}

#undef KAUSTIK_INLINE
#ifdef __cplusplus
}  // namespace kaustik::transport
#endif
