// SPDX-License-Identifier: MIT
// A view: between its view space (m) and pixels (continuous, centres at .5, lower left 0). The
// eye's, unless a command has been given others (render::RasterViews):
//   OTHER_VIEW         positions and directions of photons have to be brought into it
//   ORTHOGRAPHIC_VIEW  its rays are parallel
//   MANY_VIEWS         the faces of a cube; viewIndex says which, and arrays hold one after the other
#include "framework/transport/seen.h"
#include "framework/transport/types.h"

#ifdef MANY_VIEWS
layout(std140) uniform View {
    ViewData views[kMaxViews];
};
uniform int viewCount;
int viewIndex = 0;
#define view views[viewIndex]
#else
layout(std140) uniform View {
    ViewData view;
};
const int viewCount = 1;
const int viewIndex = 0;
#endif

// The direction through a pixel position, of a depth of 1 m.
vec3 viewRay(vec2 pixel) {
#ifdef ORTHOGRAPHIC_VIEW
    return vec3(0.0, 0.0, -1.0);
#else
    vec2 ndc = pixel * view.sizePixels.zw * 2.0 - 1.0;
    return vec3(ndc * view.frustum.xy, -1.0);
#endif
}

// The point at a depth, m, that is seen at a pixel position.
vec3 viewPoint(vec2 pixel, float depth) {
#ifdef ORTHOGRAPHIC_VIEW
    vec2 ndc = pixel * view.sizePixels.zw * 2.0 - 1.0;
    return vec3(ndc * view.frustum.xy, -depth);
#else
    return viewRay(pixel) * depth;
#endif
}

// The direction in which a point is seen; of any length.
vec3 viewDirection(vec3 positionVs) {
#ifdef ORTHOGRAPHIC_VIEW
    return vec3(0.0, 0.0, -1.0);
#else
    return positionVs;
#endif
}

vec2 pixelOf(vec3 positionVs) {
#ifdef ORTHOGRAPHIC_VIEW
    vec2 ndc = positionVs.xy / view.frustum.xy;
#else
    vec2 ndc = positionVs.xy / (-positionVs.z * view.frustum.xy);
#endif
    return (ndc * 0.5 + 0.5) * view.sizePixels.xy;
}

// Metres that one pixel covers at this depth.
float pixelFootprint(float depth) {
#ifdef ORTHOGRAPHIC_VIEW
    return view.frustum.w;
#else
    return view.frustum.w * depth;
#endif
}

// A measure of depth in which planes and rays are linear on the screen, and what is nearer is more:
// 1/z in perspective, 1/m; what is left to the far plane, m, where rays are parallel.
float nearnessOf(float depth) {
#ifdef ORTHOGRAPHIC_VIEW
    return view.farMeters.x - depth;
#else
    return 1.0 / depth;
#endif
}
float depthOfNearness(float nearness) {
#ifdef ORTHOGRAPHIC_VIEW
    return view.farMeters.x - nearness;
#else
    return 1.0 / nearness;
#endif
}

// What a nearness may be off by, after a few roundings.
float nearnessRounding(float nearness) {
#ifdef ORTHOGRAPHIC_VIEW
    return 4e-7 * view.farMeters.x;
#else
    return 4e-7 * nearness;
#endif
}

// From the eye's view space, in which photons and hits are, to this view's, and back.
vec3 pointFromEye(vec3 point) {
#ifdef OTHER_VIEW
    return (view.fromEye * vec4(point, 1.0)).xyz;
#else
    return point;
#endif
}
vec3 directionFromEye(vec3 direction) {
#ifdef OTHER_VIEW
    return mat3(view.fromEye) * direction;
#else
    return direction;
#endif
}
vec3 directionToEye(vec3 direction) {
#ifdef OTHER_VIEW
    return direction * mat3(view.fromEye);  // a rotation's inverse
#else
    return direction;
#endif
}

// Half of what the depth of a plane with unit normal `normalVs` differs by over a pixel, m; bounded
// where the plane is seen edge-on. `ray`: viewRay through the pixel's middle.
float pixelDepthExtent(vec3 ray, float depth, vec3 normalVs) {
    float slope = (abs(normalVs.x) + abs(normalVs.y)) / max(abs(dot(normalVs, ray)), 1e-4);
    return 0.5 * pixelFootprint(depth) * slope;
}

// How far a ray may pass from a surface's depth at a pixel's middle and still hit it there: a
// pixel's footprint and the extent, up to a slope.
#ifndef MAX_SLOPE
#define MAX_SLOPE kMaxPixelSlope
#endif
const float kMaxSlope = MAX_SLOPE;
float depthMargin(vec3 ray, float depth, vec3 normalVs) {
    float footprint = pixelFootprint(depth);
    float extent = pixelDepthExtent(ray, depth, normalVs);
    return footprint + min(extent, 0.5 * kMaxSlope * footprint);
}

// The area that a pixel sees of a plane with unit normal `normalVs` at this depth: exact for a
// pixel so small that its rays spread evenly. Bounded where the plane is seen edge-on.
float pixelArea(vec3 ray, float depth, vec3 normalVs) {
    float side = pixelFootprint(depth);
    return side * side / max(abs(dot(normalVs, ray)), 1e-4);
}
