// SPDX-License-Identifier: MIT
// Where a ray meets what a view shows, by iteration in its depths (WD08, section 3; SP05) and by
// even steps. Of which surfaces these are says whoever includes this: planeAt.
#include "include/views/ray_segment.glsl"

// What the view shows in a direction, as the plane of a texel.
struct SeenPlane {
    bool exists;
    ivec2 texel;
    float depth;  // at the texel's middle, m
    vec3 normal;  // unit
    vec3 middle;
};
SeenPlane planeAt(ivec2 texel);

struct PlaneSearch {
    int iterations;   // looks before the residual's test
    bool byDistance;  // the next one as far as the surface is away (SP05), not at its plane
    int steps;        // even ones along the ray, for what iterations have jumped over
    int refinements;  // bisections of the step that has found something
};

ivec2 clampedTexel(vec3 positionVs) {
    vec3 before = vec3(positionVs.xy, min(positionVs.z, -view.frustum.z));
    return clamp(ivec2(floor(pixelOf(before))), ivec2(0), ivec2(view.sizePixels.xy) - 1);
}

// By how much a point lies in front of the plane, in depth, m; below 0: behind.
float inFront(SeenPlane plane, vec3 positionVs) {
    vec3 ray = viewDirection(positionVs);
    float facing = dot(plane.normal, ray);
    // Seen edge-on a plane says nothing of the pixels next to it.
    if (abs(facing) < 1e-3 * length(ray)) return plane.depth + positionVs.z;
    return dot(plane.normal, plane.middle - positionVs) / facing * -ray.z;
}

// How far off a texel's plane a hit may lie: what its surface may differ by within the texel.
float residualTolerance(SeenPlane plane) {
    return depthMargin(viewRay(vec2(plane.texel) + 0.5), plane.depth, plane.normal);
}

struct Found {
    bool isHit;
    float t;  // m along the ray
    ivec2 texel;
};

// Whether the ray is on the surface at `t`: what iterations end with, and all that makes a hit.
bool isOn(vec3 origin, vec3 direction, float t, out SeenPlane plane) {
    vec3 there = origin + t * direction;
    plane = planeAt(clampedTexel(there));
    if (!plane.exists) return false;
    return abs(inFront(plane, there)) <= residualTolerance(plane);
}

// Where the ray meets the plane of what is seen at `t`; SP05 goes as far as that surface is away
// instead.
float nextEstimate(vec3 origin, vec3 direction, SeenPlane plane, bool byDistance) {
    if (byDistance) return distance(plane.middle, origin);
    float closing = dot(plane.normal, direction);
    if (abs(closing) < 1e-4) return distance(plane.middle, origin);
    return dot(plane.normal, plane.middle - origin) / closing;
}

Found iterate(vec3 origin, vec3 direction, float start, RaySegment segment, PlaneSearch how) {
    float t = clamp(start, segment.nearT, segment.farT);
    SeenPlane plane;
    bool isCut = false;
    for (int i = 0; i < how.iterations; ++i) {
        plane = planeAt(clampedTexel(origin + t * direction));
        if (!plane.exists) return Found(false, 0.0, ivec2(0));
        float next = nextEstimate(origin, direction, plane, how.byDistance);
        if (isnan(next) || isinf(next)) return Found(false, 0.0, ivec2(0));
        t = clamp(next, segment.nearT, segment.farT);
        isCut = t != next;
    }
    bool isHit = isOn(origin, direction, t, plane);
    // Where the view ends, the ray has not met the surface yet: it does beyond the edge, where the
    // next face of a cube sees it too.
    if (isHit && isCut) t = nextEstimate(origin, direction, plane, false);
    return Found(isHit, t, plane.texel);
}

// The first step of the ray, up to `last`, within which it goes from in front of what is seen to
// behind it; whether it has ended behind.
Found search(vec3 origin, vec3 direction, RaySegment segment, float last, PlaneSearch how,
             out bool endsBehind) {
    int steps = how.steps;
    float before = segment.nearT;
    bool wasInFront = true;
    endsBehind = false;
    for (int i = 1; i <= steps; ++i) {
        float t = parameterAtIndex(segment, float(i), float(steps));
        if (t >= last) break;
        vec3 there = origin + t * direction;
        SeenPlane plane = planeAt(clampedTexel(there));
        bool isInFront = !plane.exists || inFront(plane, there) > 0.0;
        if (wasInFront && !isInFront) {
            // By bisection: where it changes, the residual says whether that is a surface or the
            // edge of one.
            float low = before;
            float high = t;
            for (int k = 0; k < how.refinements; ++k) {
                float middle = 0.5 * (low + high);
                vec3 p = origin + middle * direction;
                SeenPlane seen = planeAt(clampedTexel(p));
                if (!seen.exists || inFront(seen, p) > 0.0) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            SeenPlane crossed;
            if (isOn(origin, direction, high, crossed)) {
                float on = nextEstimate(origin, direction, crossed, how.byDistance);
                bool isWithin = abs(on - high) <= 2.0 * (high - low);
                return Found(true, isWithin ? on : high, crossed.texel);
            }
        }
        endsBehind = !isInFront;
        wasInFront = isInFront;
        before = t;
    }
    return Found(false, 0.0, ivec2(0));
}
