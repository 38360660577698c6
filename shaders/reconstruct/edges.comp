// SPDX-License-Identifier: MIT
// reconstruct.edges: the receivers at four places of a pixel in which a surface ends, on the straight
// rays of the eye, to which dielectrics are invisible (SEEN_BY_PROCESSOR: it has traced them). Where
// all of them are on the surface that is seen at its middle the pixel is at no edge, and where there
// are more pixels than the list holds none is: which ones it holds is not the same in each frame.
// One thread a pixel of the list.
#include "include/surfaces/surface_data.glsl"
#include "include/thread.glsl"
#include "framework/transport/octahedral.h"
#include "reconstruct/edges.glsl"
#include "include/views/edge_places.glsl"
#ifndef SEEN_BY_PROCESSOR
#include "include/surfaces/bvh.glsl"  // last: what it includes is there once
#endif

uniform sampler2D receiver;
uniform sampler2D receiverSurface;
layout(rgba32f) writeonly uniform image2D edgeReceiver;
layout(rgba32f) writeonly uniform image2D edgeSamples;

// What a ray through a place of a pixel sees: `depth` negative of a mirror, m, 0 of nothing.
vec4 edgeSample(vec3 ray, float depth, vec3 shading, vec3 geometric) {
    return vec4(depth, depth > 0.0 ? pixelArea(ray, depth, geometric) : 0.0,
                packUnitVector(shading));
}

#ifdef SEEN_BY_PROCESSOR
uniform samplerBuffer seenAtPlaces;  // SeenAtPlace, two texels

vec4 receiverSeenAt(uint number, int i, vec2 place) {
    int texel = 2 * (int(number) * kEdgeSamples + i);
    vec4 shading = texelFetch(seenAtPlaces, texel);
    if (shading.w == 0.0) return vec4(0.0);
    return edgeSample(viewRay(place), shading.w, shading.xyz,
                      texelFetch(seenAtPlaces, texel + 1).xyz);
}
#else
bool isSurfaceHit(BvhRay ray, uint triangle, vec3 normal, float height) {
    uint kind = materialKind(bvhSources[triangle].material - 1u);
    return isReceiver(kind) || kind == kMaterialMirror;
}

vec4 receiverSeenAt(uint number, int i, vec2 place) {
    vec3 ray = viewRay(place);
    float perDepth = length(ray);
    // What is nearer than the near plane hides nothing.
    BvhRay local = bvhRay(ray * view.frustum.z, ray / perDepth);
    BvhHit hit = traceBvh(local, 3.0e38);
    if (hit.triangle == kBvhNone) return vec4(0.0);
    PointOnTriangle point = pointOfHit(local, hit);
    float depth = view.frustum.z + hit.distance / perDepth;
    bool isLit = isReceiver(materialKind(bvhSources[hit.triangle].material - 1u));
    return edgeSample(ray, isLit ? depth : -depth,
                      localToEye(shadingNormal(point.normal, point.geometric)),
                      localToEye(point.geometric));
}
#endif

void main() {
    uint number = threadNumber();
    if (number >= min(edges.count, edgeCapacity)) return;
    ivec2 pixel = ivec2(edgePixels[number] & 0xffffu, edgePixels[number] >> 16u);
    vec2 here = texelFetch(receiver, pixel, 0).xy;
    float depth = here.x;
    vec3 normal = texelFetch(receiverSurface, pixel, 0).xyz;
    vec2 middle = vec2(pixel) + 0.5;
    vec3 point = viewPoint(middle, depth);
    float margin = depthMargin(viewRay(middle), depth, normal);
    if (edges.count > edgeCapacity) {
        imageStore(edgeReceiver, pixel, vec4(here, 0.0, 0.0));
        return;
    }
    bool isOne = true;
    for (int i = 0; i < kEdgeSamples; ++i) {
        vec2 place = vec2(pixel) + edgePlace(i);
        vec4 seen = receiverSeenAt(number, i, place);
        isOne = isOne &&
                (depth > 0.0 ? continuesPlane(point, normal, margin, place, seen.x,
                                      unpackUnitVector(seen.zw))
                             : seen.x <= 0.0);
        imageStore(edgeSamples, edgeTexel(number, i), seen);
    }
    if (isOne) imageStore(edgeReceiver, pixel, vec4(here, 0.0, 0.0));
}
