// SPDX-License-Identifier: MIT
// Where a ray of the eye hits the next interface of the transmitting objects, in their layered
// depth (K06, section 4). The monotonic search keeps to two layers, the one that the ray has
// passed and the next one: a ray that has hit n interfaces is looked for between the layers n and
// n + 1. The search of all layers is the tracers' (exit_test.glsl).
#include "include/views/exit_test.glsl"

uniform vec3 dielectricsCenterVs;     // the box around all dielectrics, along the world's axes, m
uniform vec3 dielectricsHalfExtent;

// The part of the ray that is on the screen, within the box of the dielectrics and before `reach`.
RaySegment clipToDielectrics(vec3 origin, vec3 direction, float reach) {
    RaySegment segment = clipRay(origin, direction);
    if (!segment.visible) return segment;
    float low = segment.nearT;
    float high = min(segment.farT, reach);
    cutToBox(origin, direction, dielectricsCenterVs, dielectricsHalfExtent, low, high);
    segment.visible = low <= high;
    if (segment.visible) setEnds(segment, origin, direction, low, high);
    return segment;
}

// Whether the ray can hit the surface of a layer at this pixel at all, by its side; `t`: where it
// crosses the tangent plane there.
bool hitsLayer(TracedRay ray, ivec2 texel, int layer, out float t) {
    LayerSurface surface = layerAt(texel, layer);
    float height = heightAbove(ray.origin, surface.normal, texel, surface.depth);
    float closing = dot(surface.normal, ray.direction);
    t = abs(closing) > 1e-6 ? -height / closing : -1.0;
    return isFacingAt(ray, texel, surface);
}

// The depth of a layer, 0 where the pixel has fewer: behind its last one nothing is defined.
float depthOfLayer(ivec2 texel, int layer) {
    float depth = 0.0;
    for (int i = 0; i <= layer; ++i) {
        depth = texelFetch(layerDepths, ivec3(texel, i), 0).x;
        if (depth <= 0.0) return 0.0;
    }
    return depth;
}

// `passed`: the layer that the ray has passed last, -1 for none. "Traced through the depth layers
// until the depth along the ray is either greater than the depth in the next layer or less than the
// depth in the current layer": two texels a step. Inside of a closed object a pixel that no longer
// has the current layer is beyond its silhouette: the ray has left between two pixels.
FirstHit searchBetweenLayers(RaySegment segment, TracedRay ray, int passed, int steps) {
    float count = float(steps);
    bool isInside = isInsideClosed(ray.media);
    ivec2 before = ivec2(-1);
    for (int i = 0; i < steps; ++i) {
        float middle = float(i) + 0.5;
        ivec2 texel = texelOfStep(segment, i, steps);
        float z = depthAtIndex(segment, float(i) + 1.0, count);
        float current = passed >= 0 ? depthOfLayer(texel, passed) : 0.0;
        bool hasNext = passed + 1 < layerCount && (passed < 0 || current > 0.0);
        float next = hasNext ? texelFetch(layerDepths, ivec3(texel, passed + 1), 0).x : 0.0;
        if (isInside && passed >= 0 && current <= 0.0 && before.x >= 0) {
            for (int layer = passed + 1; layer >= passed; --layer) {
                float t;
                if (layer >= layerCount ||
                    depthOfLayer(before, layer) <= 0.0 ||
                    !hitsLayer(ray, before, layer, t)) {
                    continue;
                }
                return FirstHit(LayerHit(parameterAtIndex(segment, float(i), count), layer), before,
                                true, viewIndex, i);
            }
        }
        int layer = -1;
        if (next > 0.0 && z > next) {
            layer = passed + 1;
        } else if (current > 0.0 && z < current) {
            layer = passed;
        }
        before = texel;
        if (layer < 0) continue;
        float t;
        if (!hitsLayer(ray, texel, layer, t)) continue;
        // Where the ray comes to lie behind another part of the object it does not cross that
        // within a step or two; the paper takes it for a hit all the same.
        float from = parameterAtIndex(segment, max(middle - 2.0, 0.0), count);
        float to = parameterAtIndex(segment, min(middle + 1.0, count), count);
        bool isNear = t >= from && t <= to;
        if (!isNear && view_refraction_stop == view_refraction_stop_crossing) continue;
        t = clamp(t, from, to);
        return FirstHit(LayerHit(t, layer), texel, false, viewIndex, i);
    }
    return noHit();
}
