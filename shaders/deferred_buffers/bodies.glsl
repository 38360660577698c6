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

// How far a point lies outside of a box, m; negative within.
float outsideOfBox(vec3 positionVs, BodyBox box) {
    vec3 offset = mat3(view.viewToWorld) * (positionVs - box.centerVs.xyz);
    vec3 beyond = abs(offset) - box.halfExtent.xyz;
    return max(beyond.x, max(beyond.y, beyond.z));
}

// Between a point's depth and the next of the body's fronts that are seen in its texel and in those
// around it, m; of a body without buffers, as far as a front that is seen at a slant may be.
float distanceToFront(vec3 positionVs, int body) {
    ivec2 middle = texelAt(positionVs);
    if (body >= bodyCount) {
        const float slope = 4.0;
        return slope * distance(viewPoint(vec2(middle), -positionVs.z),
                                viewPoint(vec2(middle + 1), -positionVs.z));
    }
    ivec2 last = textureSize(bodyDepth, 0).xy - 1;
    float minimum = 3.0e38;
    for (int i = 0; i < 9; ++i) {
        ivec2 texel = clamp(middle + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
        float front = texelFetch(bodyDepth, ivec3(texel, 2 * body), 0).x;
        if (front > 0.0) minimum = min(minimum, abs(front + positionVs.z));
    }
    return minimum;
}

// On whose front a point lies that this view sees, by boxes and, where these overlap, by fronts;
// -1: on that of none that is kept.
int bodyAround(vec3 positionVs) {
    int nearest = -1;
    float minimum = 3.4e38;
    for (int i = 0; i < boxCount; ++i) {
        if (outsideOfBox(positionVs, boxes[i]) > 0.0) continue;
        int body = int(boxes[i].centerVs.w);
        float away = boxCount > 1 ? distanceToFront(positionVs, body) : 0.0;
        if (away < minimum) {
            minimum = away;
            nearest = body;
        }
    }
    return nearest < bodyCount ? nearest : -1;
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
        if (body >= bodyCount || ((visited >> uint(body)) & 1u) != 0u) continue;
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
