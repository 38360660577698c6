// SPDX-License-Identifier: MIT
// A photon's ray as every tracer through a view's layers sees it: clipped in view space, before
// anything is divided, to the part that is inside the scene's bounds, beyond the near plane and on
// the screen; then projected. Along it 1/z interpolates linearly in screen space, by index; depth
// itself where the view's rays are parallel.
#include "include/views/view.glsl"

struct RaySegment {
    bool visible;      // some part is on the screen
    uint cause;        // ledger account if nothing is hit, kAccount…
    float nearT;       // ray parameters of the ends, m
    float farT;
    vec2 nearPixel;    // pixel positions of the ends
    vec2 farPixel;
    float nearNearness;  // nearnessOf the depths at the ends
    float farNearness;
};

// Cuts [low, high] to where a + b t >= 0; returns whether the far end was cut.
bool cutHalfSpace(float a, float b, inout float low, inout float high) {
    if (b > 0.0) {
        low = max(low, -a / b);
        return false;
    }
    if (b < 0.0) {
        float t = -a / b;
        if (t < high) {
            high = t;
            return true;
        }
        return false;
    }
    if (a < 0.0) high = low - 1.0;  // parallel and outside
    return a < 0.0;
}

// The part of the ray inside a box along the world's axes.
void cutToBox(vec3 origin, vec3 direction, vec3 centerVs, vec3 halfExtent, inout float low,
              inout float high) {
    mat3 toWorld = mat3(view.viewToWorld);
    vec3 o = toWorld * (origin - centerVs);
    vec3 d = toWorld * direction;
    for (int axis = 0; axis < 3; ++axis) {
        cutHalfSpace(halfExtent[axis] + o[axis], d[axis], low, high);
        cutHalfSpace(halfExtent[axis] - o[axis], -d[axis], low, high);
    }
}

// The part of the ray beyond the near plane; returns whether the far end was cut.
bool cutToNearPlane(vec3 origin, vec3 direction, inout float low, inout float high) {
    return cutHalfSpace(-origin.z - view.frustum.z, -direction.z, low, high);
}

// The part of the ray between the sides of a frame around the view's axis, `frame` as the screen's
// is view.frustum. Returns whether the far end was cut.
bool cutToScreen(vec3 origin, vec3 direction, vec2 frame, inout float low, inout float high) {
    bool isCut = false;
    for (int axis = 0; axis < 2; ++axis) {
#ifdef ORTHOGRAPHIC_VIEW
        float depth = frame[axis];
        float rise = 0.0;
#else
        float depth = -origin.z * frame[axis];
        float rise = -direction.z * frame[axis];
#endif
        isCut = cutHalfSpace(depth - origin[axis], rise - direction[axis], low, high) || isCut;
        isCut = cutHalfSpace(depth + origin[axis], rise + direction[axis], low, high) || isCut;
    }
    return isCut;
}

// Makes [low, high] of a ray, which is beyond the near plane, the segment; projects its ends.
void setEnds(inout RaySegment segment, vec3 origin, vec3 direction, float low, float high) {
    segment.nearT = low;
    segment.farT = high;
    vec3 a = origin + low * direction;
    vec3 b = origin + high * direction;
    // Rounding may leave an end a little nearer than the near plane.
    a.z = min(a.z, -view.frustum.z);
    b.z = min(b.z, -view.frustum.z);
    segment.nearPixel = pixelOf(a);
    segment.farPixel = pixelOf(b);
    segment.nearNearness = nearnessOf(-a.z);
    segment.farNearness = nearnessOf(-b.z);
}

RaySegment clipRay(vec3 origin, vec3 direction) {
    RaySegment segment;
    float low = 0.0;
    float high = 3.0e38;
    cutToBox(origin, direction, view.boundsCenterVs.xyz, view.boundsHalfExtent.xyz, low, high);
    // Where the ray goes matters more than where it ends: without a hit, a ray that left through a
    // side of the screen is off screen, one that the near plane cut is behind the eye, and one that
    // crossed all of the scene on the screen stays unresolved.
    segment.cause = kAccountUnresolved;
    bool behind = cutToNearPlane(origin, direction, low, high);
    if (behind || low > high) segment.cause = kAccountBehindEye;
    if (low <= high) {
        bool off = cutToScreen(origin, direction, view.frustum.xy, low, high);
        if (off || low > high) segment.cause = kAccountOffScreen;
    }
#ifdef MANY_VIEWS
    segment.cause = kAccountUnresolved;  // another face goes on
#elif defined(OTHER_VIEW)
    if (segment.cause != kAccountUnresolved) segment.cause = kAccountOutsideMap;
#endif
    segment.visible = low <= high;
    if (segment.visible) setEnds(segment, origin, direction, low, high);
    return segment;
}

// Steps so that none exceeds a pixel along the longer axis.
int stepCount(RaySegment segment, int minimum, int maximum) {
    vec2 extent = abs(segment.farPixel - segment.nearPixel);
    return clamp(int(ceil(max(extent.x, extent.y))), max(minimum, 1), max(maximum, 1));
}

// The ray at index position `i` of `n` (any real number from 0 to n): depth, and ray parameter.
// Written so that both ends come out exactly and the error stays at a few units of the last place
// over any length (hard case 5).
float depthAtIndex(RaySegment segment, float i, float n) {
    float nearness = (segment.nearNearness * (n - i) + segment.farNearness * i) / n;
    return depthOfNearness(nearness);
}
float parameterAtIndex(RaySegment segment, float i, float n) {
#ifdef ORTHOGRAPHIC_VIEW
    return (segment.nearT * (n - i) + segment.farT * i) / n;
#else
    float a = segment.nearNearness * (n - i);
    float b = segment.farNearness * i;
    return (segment.nearT * a + segment.farT * b) / (a + b);
#endif
}

// The pixel under the middle of step [i, i + 1] of `n`.
ivec2 texelOfStep(RaySegment segment, int i, int n) {
    float middle = float(i) + 0.5;
    vec2 pixel =
        (segment.nearPixel * (float(n) - middle) + segment.farPixel * middle) / float(n);
    return clamp(ivec2(floor(pixel)), ivec2(0), ivec2(view.sizePixels.xy) - 1);
}
