// SPDX-License-Identifier: MIT
// Whether a photon inside a closed dielectric has come out of it between two pixels, or into a body
// that lies in it, although it crossed none of their planes: at a silhouette the surface bends away
// within a pixel, and next to it there is no layer left to hit. Between the layers of one pixel
// inside and outside are known.
#include "include/views/hit_test.glsl"

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
            // Parts of a body may overlap, or stand before a hole: it has been open since the
            // first.
            if (!isOpened) opened = surface.depth - margin;
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
// hits the other.
LayerHit testExit(RaySegment segment, TracedRay ray, int i, int n) {
    LayerHit none = LayerHit(0.0, -1);
    uint medium = ray.around.x;
    if (i == 0 || medium == 0u || isOpen(medium - 1u)) return none;
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

#ifdef NESTED_BODIES
// The layer of a body that holds a depth at a pixel, farther from its surface than a pixel tells,
// and that a ray inside of a closed dielectric, which is not in that body, can have entered by;
// layer < 0: none.
LayerHit bodyAround(TracedRay ray, ivec2 texel, float z) {
    LayerHit found = LayerHit(0.0, -1);
    if (ray.around.x == 0u || isOpen(ray.around.x - 1u)) return found;
    vec3 eyeRay = viewRay(vec2(texel) + 0.5);
    int front = -1;
    LayerSurface opened;
    for (int layer = 0; layer < layerCount; ++layer) {
        LayerSurface surface = layerAt(texel, layer);
        if (surface.depth <= 0.0) break;
        if (isOpen(surface.material - 1u) || isAround(ray, surface.material)) continue;
        if (dot(surface.normal, eyeRay) < 0.0) {
            front = layer;
            opened = surface;
        } else if (front >= 0 && surface.material == opened.material) {
            bool isWithin =
                z > opened.depth + opened.margin && z < surface.depth - surface.margin;
            bool byFront = dot(ray.direction, opened.normal) < 0.0;
            bool byBack = dot(ray.direction, surface.normal) < 0.0;
            if (isWithin && (byFront || byBack)) {
                bool isFrontNearer = z - opened.depth < surface.depth - z;
                found.layer = byFront && (isFrontNearer || !byBack) ? front : layer;
            }
            front = -1;
        }
    }
    return found;
}

// Such an entry between the pixels of steps i - 1 and i.
LayerHit testEntry(RaySegment segment, TracedRay ray, int i, int n) {
    RayStep at = rayStep(segment, i, n);
    LayerHit entry = bodyAround(ray, at.texel, at.zMiddle);
    entry.t = at.tBegin;
    if (entry.t <= 0.0) entry.layer = -1;
    return entry;
}
#endif

// Where a ray crossed a smooth surface between two pixels, and by which normals it is bent.
struct Crossing {
    float t;       // m
    vec3 shading;  // unit, outward
    vec3 geometric;
    mat3 turning;  // of the shading normal with the position, 1/m
};

// The steps know it to a pixel: it is moved, by no more, to where the surface that the pixels
// around show goes on. No triangle is known there; the surface's own normal says where its outside
// is, unless the ray does not cross it that way.
Crossing smoothCrossing(vec3 origin, vec3 direction, float t, vec4 surface, LayerSurface layer) {
    SmoothSurface around = smoothSurfaceAt(origin + t * direction, surface, layer);
    Crossing crossing = Crossing(t, around.normal, layer.normal, around.curving);
    float closing = dot(direction, around.normal);
    bool leaves = dot(direction, layer.normal) > 0.0;
    if (closing == 0.0 || (closing > 0.0) != leaves) return crossing;
    float pixel = pixelFootprint(layer.depth);
    float shift = clamp(-around.height / closing, -min(pixel, 0.5 * t), pixel);
    crossing.t = t + shift;
    crossing.shading = normalize(around.normal + around.turning * (shift * direction));
    if ((dot(direction, crossing.shading) > 0.0) == leaves) crossing.geometric = crossing.shading;
    return crossing;
}

// The shading normal alone, where the ray came out at `exitVs` past this pixel and layer.
vec3 normalAtExit(vec3 exitVs, ivec2 texel, int exitLayer) {
    vec4 surface = texelFetch(layerSurfaces, layerTexel(texel, exitLayer), 0);
    return smoothSurfaceAt(exitVs, surface, layerAt(texel, exitLayer)).normal;
}

// A layer that a ray has hit first, and at which pixel.
struct FirstHit {
    LayerHit hit;  // hit.layer < 0: none
    ivec2 pixel;
    bool isExit;  // the photon came out, or in, between two pixels
    int face;     // of many views, the one that it was hit in
    int step;     // of the ray
};

FirstHit noHit() {
    return FirstHit(LayerHit(0.0, -1), ivec2(0), false, viewIndex, 0);
}

// What one step of a ray hits: a layer's plane, or, where the scene has closed dielectrics, the
// way out of one, or into a body that lies in it, that no plane shows. Every tracer asks here.
FirstHit hitOfStep(RaySegment segment, TracedRay ray, int i, int n) {
    FirstHit found =
        FirstHit(testStep(segment, ray, i, n), texelOfStep(segment, i, n), false, viewIndex, i);
#ifdef CLOSED_DIELECTRICS
    if (found.hit.layer < 0) {
        found.hit = testExit(segment, ray, i, n);
        found.pixel = texelOfStep(segment, i - 1, n);
        found.isExit = true;
    }
#ifdef NESTED_BODIES
    if (found.hit.layer < 0) {
        found.hit = testEntry(segment, ray, i, n);
        found.pixel = texelOfStep(segment, i, n);
    }
#endif
#endif
    return found;
}

// Asks the steps [begin, end) of a ray of `n`, in order. A hit may lie half a step beyond its own,
// and the next step
// know a nearer one: it is asked too, as the reduce of all steps does.
// `asked`: how many they were.
FirstHit firstHitOfSteps(RaySegment segment, TracedRay ray, int begin, int end, int n,
                         out uint asked) {
    FirstHit first = noHit();
    asked = 0u;
    for (int i = begin; i < end; ++i) {
        ++asked;
        FirstHit found = hitOfStep(segment, ray, i, n);
        if (found.hit.layer < 0) continue;
        if (first.hit.layer < 0) {
            end = min(n, i + 2);
        } else if (found.hit.t >= first.hit.t) {
            continue;
        }
        first = found;
    }
    return first;
}
FirstHit firstHitOfSteps(RaySegment segment, TracedRay ray, int n) {
    uint asked;
    return firstHitOfSteps(segment, ray, 0, n, n, asked);
}

#ifdef MANY_VIEWS
FirstHit nearerHit(FirstHit a, FirstHit b) {
    if (a.hit.layer < 0) return b;
    return b.hit.layer >= 0 && b.hit.t < a.hit.t ? b : a;
}
#endif
