// SPDX-License-Identifier: MIT
// What a light's ray meets at any place of its view, from what the light sees by texels (WN09,
// section 3.2): on the triangles that the texels around it see, or, where these are too small to be
// in them, between four texels. The view is the light's.
#include "include/photons/light_triangle.glsl"
#include "include/surfaces/surface_data.glsl"
#include "include/views/view.glsl"

uniform usampler2DArray deferredTriangle;
uniform sampler2DArray deferredDepth;
uniform sampler2DArray deferredSurface;

#ifdef ORTHOGRAPHIC_VIEW
const bool kIsParallel = true;
#else
const bool kIsParallel = false;
#endif

// Of the eye's view space.
struct DeferredPoint {
    vec3 position;
    vec3 normal;     // unit
    vec3 geometric;  // unit, to the outside; 0: not known
    uint material;   // + 1; 0: nothing is there
    mat2x3 places;   // along the surface, m
    mat2x3 turns;    // of the normal on these ways
};

const DeferredPoint kNoPoint = DeferredPoint(vec3(0.0), vec3(0.0), vec3(0.0), 0u, mat2x3(0.0),
                                             mat2x3(0.0));

uniform vec2 cellsOfView;  // the part of the view that cells share out

// Of what a cell's middle, or a part of it, is: from -1 to 1 across all cells.
vec2 extentOfCells() { return cellsOfView * view.frustum.xy; }
vec2 placeOf(vec2 ndc) { return ndc * extentOfCells(); }
vec2 texelPlace(vec2 ndc) { return (0.5 * ndc * cellsOfView + 0.5) * view.sizePixels.xy; }

uvec2 triangleAt(ivec2 texel) {
    ivec2 last = ivec2(view.sizePixels.xy) - 1;
    if (any(lessThan(texel, ivec2(0))) || any(greaterThan(texel, last))) return uvec2(0u);
    return texelFetch(deferredTriangle, ivec3(texel, 0), 0).xy;
}

uint materialOf(uvec2 seen) { return instances[seen.x - 1u].material.x + 1u; }

vec3 pointToEye(vec3 inView) { return (inView - view.fromEye[3].xyz) * mat3(view.fromEye); }

vec3 texelToEye(ivec2 texel) {
    return pointToEye(viewPoint(vec2(texel) + 0.5, texelFetch(deferredDepth, ivec3(texel, 0), 0).x));
}
vec3 texelNormal(ivec2 texel) {
    return directionToEye(texelFetch(deferredSurface, ivec3(texel, 0), 0).xyz);
}

// How the surface goes on from a texel, to those on either side that see the same object.
void addPaths(ivec2 texel, uint object, inout DeferredPoint point) {
    for (int axis = 0; axis < 2; ++axis) {
        ivec2 step = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
        ivec2 before = triangleAt(texel - step).x == object ? texel - step : texel;
        ivec2 after = triangleAt(texel + step).x == object ? texel + step : texel;
        point.places[axis] = texelToEye(after) - texelToEye(before);
        point.turns[axis] = texelNormal(after) - texelNormal(before);
    }
}

// Between the texels around it that see the same object, by nearness and normals.
DeferredPoint interpolatedAt(vec2 ndc, uvec2 nearest) {
    vec2 corner = texelPlace(ndc) - 0.5;
    ivec2 first = ivec2(floor(corner));
    vec2 f = corner - vec2(first);
    float sum = 0.0;
    float nearness = 0.0;
    vec3 normal = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 texel = first + step;
        if (triangleAt(texel).x != nearest.x) continue;
        vec2 axis = mix(1.0 - f, f, vec2(step));
        float weight = max(axis.x * axis.y, 1e-6);
        sum += weight;
        nearness += weight * nearnessOf(texelFetch(deferredDepth, ivec3(texel, 0), 0).x);
        normal += weight * texelFetch(deferredSurface, ivec3(texel, 0), 0).xyz;
    }
    float size = length(normal);
    if (!(sum > 0.0) || !(size > 1e-6)) return kNoPoint;
    vec3 there = viewPoint(texelPlace(ndc), depthOfNearness(nearness / sum));
    vec3 toEye = directionToEye(normal / size);
    DeferredPoint point = DeferredPoint(pointToEye(there), toEye, toEye, materialOf(nearest),
                                        mat2x3(0.0), mat2x3(0.0));
    addPaths(ivec2(floor(texelPlace(ndc))), nearest.x, point);
    return point;
}

// A ray that passes a triangle by less than this share of it, within a texel, passes one that texels
// resolve.
const float kResolved = -0.1;

DeferredPoint pointAt(vec2 ndc, bool onTriangles) {
    ivec2 texel = ivec2(floor(texelPlace(ndc)));
    uvec2 nearest = triangleAt(texel);
    if (!onTriangles) return nearest.x == 0u ? kNoPoint : interpolatedAt(ndc, nearest);
    DeferredPoint found = kNoPoint;
    float foundDepth = 3.0e38;
    uvec2 before = uvec2(0u);
    uvec2 foundTriangle = uvec2(0u);
    float passedBy = -3.0e38;  // the nearest texel's triangle
    bool isAlone = true;
    for (int neighbour = 0; neighbour < 9; ++neighbour)
        isAlone = isAlone && triangleAt(texel + ivec2(neighbour % 3 - 1, neighbour / 3 - 1)).x == nearest.x;
    for (int i = 0; i < 9; ++i) {
        // The middle first; where all around see the same object, what it meets is what there is.
        int at = i == 0 ? 4 : i <= 4 ? i - 1 : i;
        uvec2 seen = triangleAt(texel + ivec2(at % 3 - 1, at / 3 - 1));
        bool isKnown = seen.x == 0u || seen == before || seen == foundTriangle;
        if (isKnown || (isAlone && found.material != 0u)) continue;
        before = seen;
        float minimum;
        PointOnTriangle point = pointOnTriangle(seen, placeOf(ndc), kIsParallel, minimum);
        if (i == 0) passedBy = minimum;
        if (minimum < -1e-5) continue;
        float depth = -pointFromEye(point.position).z;
        if (!(depth < foundDepth)) continue;
        foundDepth = depth;
        foundTriangle = seen;
        float size = max(length(point.normal), 1e-12);
        found = DeferredPoint(point.position, shadingNormal(point.normal, point.geometric),
                              point.geometric, materialOf(seen), point.places, point.turns / size);
    }
    // At the border of what is seen the ray meets what lies behind, or nothing, next to a triangle that
    // texels resolve. Of smaller ones those that it meets may be in no texel: what the nearest one sees
    // counts.
    bool isResolved = nearest.x == 0u || passedBy > kResolved;
    if (found.material != 0u && (isResolved || foundTriangle.x == nearest.x)) return found;
    if (!isAlone && isResolved) return kNoPoint;
    return nearest.x == 0u ? kNoPoint : interpolatedAt(ndc, nearest);
}
