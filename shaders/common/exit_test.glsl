// SPDX-License-Identifier: MIT
// Whether a photon inside a closed dielectric has come out of it between two pixels, although it
// crossed none of their planes: at a silhouette the surface bends away within a pixel, and beside
// it there is no layer left to meet. Between the layers of one pixel inside and outside are known.
#include "common/hit_test.glsl"

// Whether a range of depths overlaps the inside of a dielectric at a pixel. Layers come front to
// back; one that faces the eye opens the inside, one that faces away closes it. Unknown is inside:
// where the layers end before the dielectric does.
bool isInsideAt(ivec2 texel, uint medium, float zLow, float zHigh) {
    float opened = 0.0;
    bool isOpened = false;
    for (int layer = 0; layer < layerCount; ++layer) {
        LayerSurface surface = layerAt(texel, layer);
        if (surface.depth <= 0.0) return isOpened && zHigh >= opened;
        if (surface.material != medium) continue;
        float margin = surface.margin;
        if (dot(surface.normal, viewRay(vec2(texel) + 0.5)) < 0.0) {
            opened = surface.depth - margin;
            isOpened = true;
        } else {
            if (zHigh >= opened && zLow <= surface.depth + margin) return true;
            opened = surface.depth + margin;
            isOpened = false;
        }
    }
    return true;
}

// The layer through which the photon came out at its last pixel inside, step i - 1, when it is
// outside at step i: the nearest in depth of those that it can leave by. `t` is where one step
// meets the other.
LayerHit testExit(RaySegment segment, TracedRay ray, int i, int n) {
    LayerHit none = LayerHit(0.0, -1);
    if (i == 0 || !isInsideClosed(ray.media)) return none;
    uint medium = innerMedium(ray.media);
    float count = float(n);
    float zBefore = depthAtIndex(segment, float(i) - 1.0, count);
    float zBegin = depthAtIndex(segment, float(i), count);
    float zEnd = depthAtIndex(segment, float(i) + 1.0, count);
    ivec2 texel = texelOfStep(segment, i, n);
    ivec2 before = texelOfStep(segment, i - 1, n);
    if (isInsideAt(texel, medium, min(zBegin, zEnd), max(zBegin, zEnd))) return none;
    if (!isInsideAt(before, medium, min(zBefore, zBegin), max(zBefore, zBegin))) return none;
    LayerHit best = none;
    float nearest = 0.0;
    for (int layer = 0; layer < layerCount; ++layer) {
        LayerSurface surface = layerAt(before, layer);
        if (surface.depth <= 0.0) break;
        if (surface.material != medium) continue;
        float away = abs(surface.depth - zBegin);
        if (dot(ray.direction, surface.normal) <= 0.0) continue;
        if (best.layer >= 0 && away >= nearest) continue;
        best = LayerHit(parameterAtIndex(segment, float(i), count), layer);
        nearest = away;
    }
    return best.t > 0.0 ? best : none;
}

// Where a ray came out of a smooth surface between two pixels, and by which normals it is bent.
struct Exit {
    float t;         // m
    vec3 shading;    // unit, outward
    vec3 geometric;
};

// The steps know it to a pixel: it is moved, by no more, to where the surface that the pixels
// around show goes on. No triangle is known there; the surface's own normal says where its outside
// is, unless the ray does not leave by it.
Exit smoothExit(vec3 origin, vec3 direction, float t, vec4 surface, LayerSurface layer) {
    SmoothSurface around = smoothSurfaceAt(origin + t * direction, surface, layer);
    Exit exit = Exit(t, around.normal, layer.normal);
    float closing = dot(direction, around.normal);
    if (closing <= 0.0) return exit;
    float pixel = pixelFootprint(layer.depth);
    float way = clamp(-around.height / closing, -min(pixel, 0.5 * t), pixel);
    exit.t = t + way;
    exit.shading = normalize(around.normal + around.turning * (way * direction));
    if (dot(direction, exit.shading) > 0.0) exit.geometric = exit.shading;
    return exit;
}

// The shading normal alone, where the ray came out at `exitVs` past this pixel and layer.
vec3 normalAtExit(vec3 exitVs, ivec2 texel, int exitLayer) {
    vec4 surface = texelFetch(layerSurfaces, ivec3(texel, exitLayer), 0);
    return smoothSurfaceAt(exitVs, surface, layerAt(texel, exitLayer)).normal;
}

// A layer that a ray has met first, and at which pixel.
struct FirstHit {
    LayerHit hit;  // hit.layer < 0: none
    ivec2 pixel;
    bool isExit;  // the photon came out between two pixels
};

FirstHit noHit() {
    return FirstHit(LayerHit(0.0, -1), ivec2(0), false);
}

// What one step of a ray meets: a layer's plane, or, where the scene has closed dielectrics, the
// way out of one that no plane shows. Every tracer asks here.
FirstHit hitOfStep(RaySegment segment, TracedRay ray, int i, int n) {
    FirstHit found = FirstHit(testStep(segment, ray, i, n), texelOfStep(segment, i, n), false);
#ifdef CLOSED_DIELECTRICS
    if (found.hit.layer < 0) {
        found.hit = testExit(segment, ray, i, n);
        found.pixel = texelOfStep(segment, i - 1, n);
        found.isExit = true;
    }
#endif
    return found;
}

// Asks the steps of a ray in order. A hit may lie half a step beyond its own, and the next step
// know a nearer one: it is asked too, as the reduce of all steps does.
FirstHit firstHitOfSteps(RaySegment segment, TracedRay ray, int n) {
    FirstHit first = noHit();
    int end = n;
    for (int i = 0; i < end; ++i) {
        FirstHit found = hitOfStep(segment, ray, i, n);
        if (found.hit.layer < 0) continue;
        if (first.hit.layer < 0) {
            end = min(end, i + 2);
        } else if (found.hit.t >= first.hit.t) {
            continue;
        }
        first = found;
    }
    return first;
}
