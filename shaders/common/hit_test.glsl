// SPDX-License-Identifier: MIT
// Whether a step of a photon's ray meets a surface of the layered depth. All tracers ask here.
#include "common/octahedral.glsl"
#include "common/ray_segment.glsl"
#include "common/specular.glsl"

uniform sampler2DArray layerDepths;
uniform sampler2DArray layerSurfaces;
uniform sampler2DArray layerNormals;
uniform int layerCount;

struct TracedRay {
    vec3 origin;
    vec3 direction;
    uint media;
};

// A photon inside a dielectric can meet that dielectric only from within, any other dielectric and
// any closed mirror only from outside. So a ray never meets the surface that it has just left, at
// any scale (hard case 10); receivers end it from either side, and so do open mirrors, but for the
// one that it has left on that side and is still no farther from than a pixel resolves.
// `normal`: the triangle's, outward; `height`: the ray's origin above its plane, m.
bool isFacing(TracedRay ray, uint material, vec3 normal, float height, float resolved) {
    uint kind = materialKind(material - 1u);
    if (isReceiver(kind)) return true;
    bool leaves = dot(ray.direction, normal) > 0.0;
    if (kind == kMaterialMirror && isOpen(material - 1u)) {
        uint left = leaves ? kLeftOutside : kLeftInside;
        return leftSide(ray.media) != left || abs(height) > resolved;
    }
    bool isInside = kind == kMaterialDielectric && innerMedium(ray.media) == material;
    return leaves == isInside;
}

// How far a point lies above the plane with this normal through what a pixel sees at this depth, m.
float heightAbove(vec3 point, vec3 normal, ivec2 texel, float depth) {
    return dot(normal, point - viewRay(vec2(texel) + 0.5) * depth);
}

struct LayerHit {
    float t;    // ray parameter, m; 0: none
    int layer;
};

// Tests the step [i, i + 1] of `n` against every layer of the pixel in its middle; the nearest hit
// along the ray (hard case 11).
LayerHit testStep(RaySegment segment, TracedRay ray, int i, int n) {
    float middle = float(i) + 0.5;
    float count = float(n);
    vec2 pixel = (segment.nearPixel * (count - middle) + segment.farPixel * middle) / count;
    ivec2 texel = clamp(ivec2(floor(pixel)), ivec2(0), ivec2(view.sizePixels.xy) - 1);
    float zBegin = depthAtIndex(segment, float(i), count);
    float zEnd = depthAtIndex(segment, float(i) + 1.0, count);
    float zLow = min(zBegin, zEnd);
    float zHigh = max(zBegin, zEnd);
    bool nears = zEnd < zBegin;  // the eye: then a deeper layer is nearer along the ray
    LayerHit best = LayerHit(0.0, -1);
    for (int layer = 0; layer < layerCount; ++layer) {
        vec2 surfaceDepth = texelFetch(layerDepths, ivec3(texel, layer), 0).xy;
        float depth = surfaceDepth.x;
        if (depth <= 0.0) break;
        float margin = surfaceDepth.y + pixelFootprint(depth);
        float t;
        if (trace_test == trace_test_epsilon) {
            // The paper's: a layer is met where it lies within a distance of the fragment's depth.
            float zMiddle = depthAtIndex(segment, middle, count);
            if (abs(depth - zMiddle) > trace_epsilon) continue;
            t = parameterAtIndex(segment, middle, count);
        } else {
            // The depths that the surface and the ray have over this pixel must overlap …
            if (depth + margin < zLow || depth - margin > zHigh) continue;
            // … and the ray must cross the triangle's plane within this step, or half a step beside
            // it: two neighbours' planes may leave a gap between them.
            vec3 normal = unpackUnitVector(texelFetch(layerNormals, ivec3(texel, layer), 0).xy);
            float closing = dot(normal, ray.direction);
            if (abs(closing) < 1e-6) continue;
            t = -heightAbove(ray.origin, normal, texel, depth) / closing;
            float tBegin = parameterAtIndex(segment, float(i), count);
            float tEnd = parameterAtIndex(segment, float(i) + 1.0, count);
            float slack = 0.5 * (tEnd - tBegin) + 1e-6 * depth;
            if (t < tBegin - slack || t > tEnd + slack) continue;
        }
        if (t <= 0.0) continue;
        // The paper's test cannot tell surfaces within epsilon apart by t.
        if (best.layer >= 0 && (t > best.t || (t == best.t && !nears))) continue;
        uint material = uint(texelFetch(layerSurfaces, ivec3(texel, layer), 0).w);
        vec3 normal = unpackUnitVector(texelFetch(layerNormals, ivec3(texel, layer), 0).xy);
        float height = heightAbove(ray.origin, normal, texel, depth);
        if (!isFacing(ray, material, normal, height, margin)) continue;
        best = LayerHit(t, layer);
    }
    return best;
}

ivec2 texelOfStep(RaySegment segment, int i, int n) {
    float middle = float(i) + 0.5;
    vec2 pixel =
        (segment.nearPixel * (float(n) - middle) + segment.farPixel * middle) / float(n);
    return clamp(ivec2(floor(pixel)), ivec2(0), ivec2(view.sizePixels.xy) - 1);
}

// The surface's normal where the ray meets it: bilinear between the pixels around the hit, each with
// the layer that continues the surface; the normal of one pixel alone would send all photons that
// meet it the same way. `surface` and `depth` are those of the hit's own pixel and layer.
vec3 normalAtHit(vec3 hitVs, vec4 surface, vec2 depthAndExtent) {
    vec2 corner = pixelOf(hitVs) - 0.5;
    ivec2 first = ivec2(floor(corner));
    vec2 f = corner - vec2(first);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 texel = clamp(first + step, ivec2(0), ivec2(view.sizePixels.xy) - 1);
        vec2 axis = mix(1.0 - f, f, vec2(step));
        vec3 ray = viewRay(vec2(texel) + 0.5);
        for (int layer = 0; layer < layerCount; ++layer) {
            float depth = texelFetch(layerDepths, ivec3(texel, layer), 0).x;
            if (depth <= 0.0) break;
            // The same surface lies within a pixel's extent of the hit's own depth.
            float reach = 2.0 * depthAndExtent.y + 2.0 * pixelFootprint(depth);
            if (abs(depth - depthAndExtent.x) > reach) continue;
            vec4 other = texelFetch(layerSurfaces, ivec3(texel, layer), 0);
            // A crease of more than 60 degrees is an edge, not a curve.
            if (other.w != surface.w || dot(other.xyz, surface.xyz) < 0.5) continue;
            sum += axis.x * axis.y * other.xyz;
            break;
        }
    }
    float size = length(sum);
    return size > 1e-3 ? sum / size : surface.xyz;
}

// The normal of a receiver: the shading normal, unless that takes the eye or the arriving light for
// being on the other side than the triangle does.
vec3 receiverNormal(vec3 positionVs, vec3 direction, vec3 shading, vec3 geometric) {
    bool sameLight = (dot(direction, shading) < 0.0) == (dot(direction, geometric) < 0.0);
    bool sameEye = (dot(positionVs, shading) < 0.0) == (dot(positionVs, geometric) < 0.0);
    return sameLight && sameEye ? shading : geometric;
}
