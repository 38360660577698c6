// SPDX-License-Identifier: MIT
// The eye's view: between view space (m) and pixels (continuous, centres at .5, lower left 0).
#include "framework/transport/types.h"

layout(std140) uniform View {
    ViewData view;
};

// The direction through a pixel position, at a depth of 1 m: multiply by depth for the point.
vec3 viewRay(vec2 pixel) {
    vec2 ndc = pixel * view.sizePixels.zw * 2.0 - 1.0;
    return vec3(ndc * view.tangents.xy, -1.0);
}

vec2 pixelOf(vec3 positionVs) {
    vec2 ndc = positionVs.xy / (-positionVs.z * view.tangents.xy);
    return (ndc * 0.5 + 0.5) * view.sizePixels.xy;
}

// Metres that one pixel covers at this depth.
float pixelFootprint(float depth) {
    return view.tangents.w * depth;
}

// Half of what the depth of a plane with unit normal `normalVs` differs by over a pixel, m; bounded
// where the plane is seen edge-on. `ray`: viewRay through the pixel's middle.
float pixelDepthExtent(vec3 ray, float depth, vec3 normalVs) {
    float slope = (abs(normalVs.x) + abs(normalVs.y)) / max(abs(dot(normalVs, ray)), 1e-4);
    return 0.5 * pixelFootprint(depth) * slope;
}

// How far a ray may pass from a surface's depth at a pixel's middle and still hit it there: a
// pixel's footprint and the extent. A surface seen more nearly edge-on than this slope is taken for
// the silhouette of something thin, which ends within the pixel: without a bound rays hit its
// plane far in front of it and beyond (cornell-bunny: 99.0 % of the photons right without, 99.4 %
// with 8, 98.8 % with 3).
const float kSteepestSlope = 8.0;
float depthMargin(vec3 ray, float depth, vec3 normalVs) {
    float footprint = pixelFootprint(depth);
    float extent = pixelDepthExtent(ray, depth, normalVs);
    return footprint + min(extent, 0.5 * kSteepestSlope * footprint);
}

// The area that a pixel sees of a plane with unit normal `normalVs` at this depth: exact for a
// pixel so small that its rays spread evenly. Bounded where the plane is seen edge-on.
float pixelArea(vec3 ray, float depth, vec3 normalVs) {
    float side = pixelFootprint(depth);
    return side * side / max(abs(dot(normalVs, ray)), 1e-4);
}
