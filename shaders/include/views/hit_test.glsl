// SPDX-License-Identifier: MIT
// Whether a step of a photon's ray hits a surface of the layered depth. All tracers ask here.
#include "framework/transport/octahedral.h"
#include "include/views/ray_segment.glsl"
#include "include/surfaces/side_rule.glsl"

uniform sampler2DArray layerDepths;
uniform sampler2DArray layerSurfaces;
uniform int layerCount;

// What a layer has at a pixel: depth 0 where nothing.
struct LayerSurface {
    float depth;   // m
    float margin;  // by which a ray may pass in front of or beyond it and still hit it, m
    vec3 normal;   // the triangle's, outward
    uint material;  // index + 1
};

// Where a layer of the view is in the arrays.
ivec3 layerTexel(ivec2 texel, int layer) {
    return ivec3(texel, viewIndex * layerCount + layer);
}

LayerSurface layerAt(ivec2 texel, int layer) {
    vec4 data = texelFetch(layerDepths, layerTexel(texel, layer), 0);
    vec3 normal = unpackUnitVector(data.yz);
    float margin = depthMargin(viewRay(vec2(texel) + 0.5), data.x, normal);
    return LayerSurface(data.x, margin, normal, uint(data.w));
}

// How far a point lies above the plane with this normal through what a pixel sees at this depth, m.
float heightAbove(vec3 point, vec3 normal, ivec2 texel, float depth) {
    return dot(normal, point - viewPoint(vec2(texel) + 0.5, depth));
}

struct LayerHit {
    float t;    // ray parameter, m; 0: none
    int layer;
};

// One step [i, i + 1] of `n` along a ray.
struct RayStep {
    ivec2 texel;  // under its middle
    float zBegin;
    float zEnd;
    float tBegin;  // ray parameters, m
    float tEnd;
    float zMiddle;
    float tMiddle;
};

RayStep rayStep(RaySegment segment, int i, int n) {
    float first = float(i);
    float count = float(n);
    return RayStep(texelOfStep(segment, i, n), depthAtIndex(segment, first, count),
                   depthAtIndex(segment, first + 1.0, count),
                   parameterAtIndex(segment, first, count),
                   parameterAtIndex(segment, first + 1.0, count),
                   depthAtIndex(segment, first + 0.5, count),
                   parameterAtIndex(segment, first + 0.5, count));
}

#ifdef IN_OUT_TEST
// Whether the ray is between this layer and the one that bounds the same solid with it: its front
// and its back are consecutive layers (K06, section 5: "an additional in-out test considering
// consecutive pairs of layered depth images"). Not for solids that the ray is inside of: see
// testExit.
bool isInSolid(TracedRay ray, RayStep at, int layer, LayerSurface surface) {
    if (isOpen(surface.material - 1u) || isAround(ray, surface.material)) return false;
    vec3 eyeRay = viewRay(vec2(at.texel) + 0.5);
    bool isFront = dot(surface.normal, eyeRay) < 0.0;
    int next = isFront ? layer + 1 : layer - 1;
    if (next < 0 || next >= layerCount) return false;
    LayerSurface other = layerAt(at.texel, next);
    if (other.depth <= 0.0 || other.material != surface.material) return false;
    if ((dot(other.normal, eyeRay) < 0.0) == isFront) return false;
    // It has come in by the side that faces it, however far behind that the step's middle lies.
    if (dot(surface.normal, ray.direction) > 0.0 && dot(other.normal, ray.direction) < 0.0)
        return false;
    return at.zMiddle >= min(surface.depth, other.depth) &&
           at.zMiddle <= max(surface.depth, other.depth);
}
#endif

// Where the ray crosses the plane of the surface that a layer has at the step's pixel, whichever
// side that shows; m, 0: nowhere in this step.
float crossLayer(TracedRay ray, RayStep at, LayerSurface surface) {
    float depth = surface.depth;
    // The depths that the surface and the ray have over this pixel must overlap …
    if (depth + surface.margin < min(at.zBegin, at.zEnd) ||
        depth - surface.margin > max(at.zBegin, at.zEnd)) {
        return 0.0;
    }
    // … and the ray must cross the triangle's plane within this step, or half a step next to it: two
    // neighbours' planes may leave a gap between them.
    float closing = dot(surface.normal, ray.direction);
    if (abs(closing) < 1e-6) return 0.0;
    float t = -heightAbove(ray.origin, surface.normal, at.texel, depth) / closing;
    float slack = 0.5 * (at.tEnd - at.tBegin) + 1e-6 * depth;
    return t < at.tBegin - slack || t > at.tEnd + slack ? 0.0 : max(t, 0.0);
}

// Where the ray hits that surface by the test that is chosen; m, 0: nowhere in this step.
float hitLayer(TracedRay ray, RayStep at, int layer, LayerSurface surface) {
    if (surface.depth <= 0.0) return 0.0;
#ifdef EPSILON_TEST
    // The paper's: a layer is hit where it lies within a distance of the fragment's depth.
    bool isHit = abs(surface.depth - at.zMiddle) <= trace_epsilon;
#ifdef IN_OUT_TEST
    isHit = isHit || isInSolid(ray, at, layer, surface);
#endif
    return isHit ? at.tMiddle : 0.0;
#else
    return crossLayer(ray, at, surface);
#endif
}

// Whether a surface that the ray hits there is one that ends or turns it.
bool isFacingAt(TracedRay ray, ivec2 texel, LayerSurface surface) {
    float height = heightAbove(ray.origin, surface.normal, texel, surface.depth);
    return isFacing(ray, surface.material, surface.normal, height, surface.margin);
}

// Whether a hit on a layer's plane may lie on the solid that it bounds. Where a solid is about a
// pixel thick its planes are those of its silhouette, and go on far in front of it and beyond; but
// a front and the back behind it meet half-way.
bool isOnSolid(TracedRay ray, ivec2 texel, int layer, LayerSurface surface, float t) {
#ifdef IN_OUT_TEST
    return true;  // it asks for depths between a front and its back, and not for their planes
#endif
    vec3 eyeRay = viewRay(vec2(texel) + 0.5);
    bool isFront = dot(surface.normal, eyeRay) < 0.0;
    int next = isFront ? layer + 1 : layer - 1;
    if (next < 0 || next >= layerCount) return true;
    LayerSurface other = layerAt(texel, next);
    if (other.depth <= 0.0 || other.material != surface.material) return true;
    if ((dot(other.normal, eyeRay) < 0.0) == isFront) return true;
    float middle = 0.5 * (surface.depth + other.depth);
    float beyond = -(ray.origin.z + t * ray.direction.z) - middle;
    return (isFront ? beyond : -beyond) <= pixelFootprint(middle);
}

// Of two surfaces the one nearer along the ray (hard case 11). The paper's test cannot tell those
// of one step apart by t: where the ray comes nearer to the eye, the deeper layer is.
bool isNearer(float t, float before, RayStep at, bool isSameStep) {
    return t < before || (t == before && isSameStep && at.zEnd < at.zBegin);
}

// Tests one step against every layer of its pixel; the nearest hit along the ray.
LayerHit testStep(RaySegment segment, TracedRay ray, int i, int n) {
    RayStep at = rayStep(segment, i, n);
    LayerHit best = LayerHit(0.0, -1);
    for (int layer = 0; layer < layerCount; ++layer) {
        LayerSurface surface = layerAt(at.texel, layer);
        if (surface.depth <= 0.0) break;
        float t = hitLayer(ray, at, layer, surface);
        if (t <= 0.0 || (best.layer >= 0 && !isNearer(t, best.t, at, true))) continue;
        if (isFacingAt(ray, at.texel, surface) && isOnSolid(ray, at.texel, layer, surface, t))
            best = LayerHit(t, layer);
    }
    return best;
}

// How far in depth the samples of one smooth surface may lie apart, px: at the silhouette of a ball
// its front and its back are farther apart than a pixel's extent. From kNearReach on they count
// less.
const float kSmoothReach = 32.0;
const float kNearReach = 4.0;
// Directions along which the samples lie nearer together than this say little of a slope, px.
const float kMinSpread = 0.17;

// A smooth surface around a point of it, from what the pixels around show of it: its normal is
// taken to change evenly with the position, as on a sphere it does exactly. Where a silhouette
// leaves pixels on one side only, the mean of their normals would be many degrees off, and light
// would be caught inside; front and back meet there and both count.
struct SmoothSurface {
    vec3 normal;   // at the point, unit
    mat3 turning;  // of the normal with the position, 1/m; less where the samples say little of it
    float height;  // of the point above the surface, m
    mat3 curving;  // the turning without that loss: what beams go by
};

SmoothSurface smoothSurfaceAt(vec3 pointVs, vec4 surface, LayerSurface layerHit) {
    vec2 corner = pixelOf(pointVs) - 0.5;
    ivec2 first = ivec2(floor(corner));
    vec2 f = corner - vec2(first);
    float extent = pixelDepthExtent(viewRay(pixelOf(pointVs)), layerHit.depth, layerHit.normal);
    float footprint = pixelFootprint(layerHit.depth);
    float reach = 2.0 * extent + kSmoothReach * footprint;
    float near = kNearReach * footprint;
    float minimum = kMinSpread * footprint;
    // Weighted sums over the samples, positions from the point: the mean of position and normal,
    // and of their products.
    float weights = 0.0;
    vec3 meanPosition = vec3(0.0);
    vec3 meanNormal = vec3(0.0);
    float meanHeight = 0.0;
    mat3 spread = mat3(0.0);
    mat3 turned = mat3(0.0);
#ifdef PHOTON_BEAMS
    // A slope is told best from samples that all count alike.
    float evenWeights = 0.0;
    vec3 evenPosition = vec3(0.0);
    vec3 evenNormal = vec3(0.0);
    mat3 evenSpread = mat3(0.0);
    mat3 evenTurned = mat3(0.0);
#endif
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 texel = clamp(first + step, ivec2(0), ivec2(view.sizePixels.xy) - 1);
        vec2 axis = mix(1.0 - f, f, vec2(step));
        for (int layer = 0; layer < layerCount; ++layer) {
            float depth = texelFetch(layerDepths, layerTexel(texel, layer), 0).x;
            if (depth <= 0.0) break;
            if (abs(depth - layerHit.depth) > reach) continue;
            vec4 other = texelFetch(layerSurfaces, layerTexel(texel, layer), 0);
            // A crease of more than 60 degrees is an edge, not a curve.
            if (other.w != surface.w || dot(other.xyz, surface.xyz) < 0.5) continue;
            vec3 offset = viewPoint(vec2(texel) + 0.5, depth) - pointVs;
            // All pixels count a little, so that there are enough to tell a slope from.
            float nearness = 1.0 / (1.0 + dot(offset, offset) / (near * near));
            float weight = (axis.x * axis.y + 1e-3) * nearness;
            weights += weight;
            meanPosition += weight * offset;
            meanNormal += weight * other.xyz;
            meanHeight -= weight * dot(other.xyz, offset);
            spread += weight * outerProduct(offset, offset);
            turned += weight * outerProduct(other.xyz, offset);
#ifdef PHOTON_BEAMS
            evenWeights += nearness;
            evenPosition += nearness * offset;
            evenNormal += nearness * other.xyz;
            evenSpread += nearness * outerProduct(offset, offset);
            evenTurned += nearness * outerProduct(other.xyz, offset);
#endif
        }
    }
    SmoothSurface result = SmoothSurface(surface.xyz, mat3(0.0), 0.0, mat3(0.0));
    if (weights <= 0.0) return result;
    meanPosition /= weights;
    meanNormal /= weights;
    meanHeight /= weights;
    spread = spread / weights - outerProduct(meanPosition, meanPosition);
    turned = turned / weights - outerProduct(meanNormal, meanPosition);
    result.turning = turned * inverse(spread + mat3(minimum * minimum));
    vec3 normal = meanNormal - result.turning * meanPosition;
    float size = length(normal);
    if (size < 1e-3) return result;
    result.normal = normal / size;
    // A chord hits the surface at equal angles at both ends.
    result.height = 0.5 * (meanHeight - dot(result.normal, meanPosition));
#ifdef PHOTON_BEAMS
    evenPosition /= evenWeights;
    evenSpread = evenSpread / evenWeights - outerProduct(evenPosition, evenPosition);
    evenTurned = evenTurned / evenWeights - outerProduct(evenNormal / evenWeights, evenPosition);
    // What keeps the inverse finite is taken back where the samples tell (iterated Tikhonov
    // regularisation): a tenth is lost without, a ten-thousandth so.
    mat3 solve = inverse(evenSpread + mat3(minimum * minimum));
    for (int i = 0; i < 4; ++i)
        result.curving += (evenTurned - result.curving * evenSpread) * solve;
#endif
    return result;
}
