// SPDX-License-Identifier: MIT
// Fronts and backs of several bodies in one view (techniques/deferred_buffers/body_buffers.h),
// and which of them a ray meets.
#include "include/views/faces.glsl"
#include "techniques/deferred_buffers/body_data.h"
#ifdef SEVERAL_BODIES
#include "include/views/plane_search.glsl"
#endif

// A front and a back a body, in layers 2i and 2i + 1, and, where there are SEVERAL_BODIES, the
// first opaque surface after them.
uniform sampler2DArray bodyDepth;    // 0 none
uniform sampler2DArray bodySurface;  // outward normals; w: material + 1
layout(std430) readonly buffer BodyBoxes {
    BodyBox boxes[];
};
uniform int boxCount;
#ifdef SEVERAL_BODIES
uniform int bodyCount;
#else
const int bodyCount = 1;
#endif
int bodyIndex = 0;  // the one whose faces are asked for

float faceDepth(ivec2 texel, int face) {
    return texelFetch(bodyDepth, ivec3(texel, 2 * bodyIndex + face), 0).x;
}
vec3 faceNormal(ivec2 texel, int face) {
    return texelFetch(bodySurface, ivec3(texel, 2 * bodyIndex + face), 0).xyz;
}
uint frontMaterial(ivec2 texel) {
    return uint(texelFetch(bodySurface, ivec3(texel, 2 * bodyIndex), 0).w);
}
#ifdef PHOTON_BEAMS
uniform sampler2DArray bodyShape;

vec3 faceShape(ivec2 texel, int face) {
    return texelFetch(bodyShape, ivec3(texel, 2 * bodyIndex + face), 0).xyz;
}
#endif

// On whose surface a point lies; -1: on that of none that is kept.
int bodyAround(vec3 positionVs) {
    int nearest = -1;
    float minimum = 0.0;
    for (int i = 0; i < boxCount; ++i) {
        vec3 offset = mat3(view.viewToWorld) * (positionVs - boxes[i].centerVs.xyz);
        vec3 beyond = abs(offset) - boxes[i].halfExtent.xyz;
        float farthest = max(beyond.x, max(beyond.y, beyond.z));
        if (farthest <= 0.0 && farthest < minimum) {
            minimum = farthest;
            nearest = int(boxes[i].centerVs.w);
        }
    }
    return nearest;
}

#ifdef SEVERAL_BODIES
// The front, unless the view sees something opaque before it.
SeenPlane planeAt(ivec2 texel) {
    float opaque = texelFetch(bodyDepth, ivec3(texel, 2 * bodyCount), 0).x;
    SeenPlane plane;
    plane.texel = texel;
    plane.depth = faceDepth(texel, kFrontFace);
    plane.exists = plane.depth > 0.0 && !(opaque > 0.0 && opaque < plane.depth);
    plane.normal = faceNormal(texel, kFrontFace);
    plane.middle = viewPoint(vec2(texel) + 0.5, plane.depth);
    return plane;
}

// The part of a ray that is in a box and in the view.
RaySegment clipToBox(vec3 origin, vec3 direction, BodyBox box) {
    RaySegment segment;
    float low = 0.0;
    float high = 3.0e38;
    cutToBox(origin, direction, box.centerVs.xyz, box.halfExtent.xyz, low, high);
    cutToNearPlane(origin, direction, low, high);
    if (low <= high) cutToScreen(origin, direction, view.frustum.xy, low, high);
    segment.visible = low <= high;
    segment.cause = kAccountUnresolved;
    if (segment.visible) setEnds(segment, origin, direction, low, high);
    return segment;
}

// Where a ray meets a body next; body -1: it meets none.
struct BodyHit {
    int body;
    float t;       // m along the ray
    ivec2 texel;   // of the front that it meets
    vec3 normal;   // outward, unit, in the view
    uint material; // + 1
};

// The nearest of the bodies that are not among those of `visited`, a bit each, by the fronts that are
// seen of them.
BodyHit nextBody(vec3 origin, vec3 direction, uint visited, PlaneSearch how) {
    BodyHit nearest = BodyHit(-1, 3.0e38, ivec2(0), vec3(0.0), 0u);
    for (int i = 0; i < boxCount; ++i) {
        int body = int(boxes[i].centerVs.w);
        if (((visited >> uint(body)) & 1u) != 0u) continue;
        RaySegment segment = clipToBox(origin, direction, boxes[i]);
        if (!segment.visible || segment.nearT >= nearest.t) continue;
        bodyIndex = body;
        Found found = iterate(origin, direction, segment.nearT, segment, how);
        bool endsBehind;
        Found before = search(origin, direction, segment, found.isHit ? found.t : 3.0e38, how,
                              endsBehind);
        if (before.isHit) found = before;
        if (!found.isHit || found.t >= nearest.t) continue;
        vec3 normal = normalAround(origin + found.t * direction, found.texel, kFrontFace);
        // At the rim the next texels' fronts may look away from the ray: it passes by.
        if (!(dot(normal, direction) < 0.0)) continue;
        nearest = BodyHit(body, found.t, found.texel, normal, frontMaterial(found.texel));
    }
    return nearest;
}
#endif
