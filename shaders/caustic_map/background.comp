// SPDX-License-Identifier: MIT
// trace.background: where a photon's ray meets what its light sees, by iteration in the light's
// depths (WD08, section 3; SP05). One thread a photon of one light.
#include "include/deliver.glsl"
#include "include/photon_thread.glsl"
#include "include/ray_segment.glsl"
#include "include/store_hits.glsl"
#include "screen_space_photons/seen_receiver.glsl"

uniform int lightIndex;

// What the light sees in a direction, as the plane of a texel.
struct SeenPlane {
    bool exists;
    ivec2 texel;
    float depth;  // at the texel's middle, m
    vec3 normal;  // unit
    vec3 middle;
};

SeenPlane planeAt(ivec2 texel) {
    SeenPlane plane;
    plane.texel = texel;
    plane.depth = max(receiverAt(texel).x, 0.0);
    plane.exists = plane.depth > 0.0;
    plane.normal = receiverSurfaceAt(texel).xyz;
    plane.middle = viewPoint(vec2(texel) + 0.5, plane.depth);
    return plane;
}

ivec2 clampedTexel(vec3 positionVs) {
    vec3 before = vec3(positionVs.xy, min(positionVs.z, -view.frustum.z));
    return clamp(ivec2(floor(pixelOf(before))), ivec2(0), ivec2(view.sizePixels.xy) - 1);
}

// By how much a point lies in front of the plane, in depth, m; below 0: behind.
float inFront(SeenPlane plane, vec3 positionVs) {
    vec3 ray = viewDirection(positionVs);
    float facing = dot(plane.normal, ray);
    // Seen edge-on a plane says nothing of the pixels beside it.
    if (abs(facing) < 1e-3 * length(ray)) return plane.depth + positionVs.z;
    return dot(plane.normal, plane.middle - positionVs) / facing * -ray.z;
}

// How far off a texel's plane a hit may lie: what its surface may differ by within the texel.
float residualAllowed(SeenPlane plane) {
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
    return abs(inFront(plane, there)) <= residualAllowed(plane);
}

// Where the ray meets the plane of what is seen at `t`; SP05 goes as far as that surface is away
// instead.
float nextEstimate(vec3 origin, vec3 direction, SeenPlane plane) {
    if (trace_background_step == trace_background_step_distance)
        return distance(plane.middle, origin);
    float closing = dot(plane.normal, direction);
    if (abs(closing) < 1e-4) return distance(plane.middle, origin);
    return dot(plane.normal, plane.middle - origin) / closing;
}

Found iterate(vec3 origin, vec3 direction, float start, RaySegment segment) {
    float t = clamp(start, segment.nearT, segment.farT);
    SeenPlane plane;
    for (int i = 0; i < trace_background_iterations; ++i) {
        plane = planeAt(clampedTexel(origin + t * direction));
        if (!plane.exists) return Found(false, 0.0, ivec2(0));
        float next = nextEstimate(origin, direction, plane);
        if (isnan(next) || isinf(next)) return Found(false, 0.0, ivec2(0));
        t = clamp(next, segment.nearT, segment.farT);
    }
    bool isHit = isOn(origin, direction, t, plane);
    return Found(isHit, t, plane.texel);
}

// The first step of the ray, up to `last`, within which it goes from in front of what is seen to
// behind it; whether it has ended behind.
Found search(vec3 origin, vec3 direction, RaySegment segment, float last, out bool endsBehind) {
    int steps = trace_background_steps;
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
            for (int k = 0; k < trace_background_refinements; ++k) {
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
                float on = nextEstimate(origin, direction, crossed);
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

Found findInView(vec3 origin, vec3 direction, out uint cause) {
    RaySegment segment = clipRay(origin, direction);
    cause = segment.cause;
    if (!segment.visible) return Found(false, 0.0, ivec2(0));
    // SP05 starts with what the light's own ray would have hit.
    SeenPlane straight = planeAt(clampedTexel(origin));
    float start = straight.exists ? distance(straight.middle, origin) : segment.farT;
    Found found = iterate(origin, direction, start, segment);
    if (trace_background_steps == 0) {
        // An iteration that has ended nowhere.
        if (cause == kAccountUnresolved) cause = kAccountMissedByTracer;
        return found;
    }
    // Iteration may have jumped over what lies before.
    bool endsBehind;
    Found nearer = search(origin, direction, segment, found.isHit ? found.t : 3.0e38, endsBehind);
    if (nearer.isHit) return nearer;
    if (!found.isHit && endsBehind) cause = kAccountHiddenInMap;
    return found;
}

Hit traced(Photon photon) {
    if (!isNumber(photon)) {
        ledgerAdd(kAccountNotANumber, vec3(0.0));
        return nothingHit();
    }
    // The far side of a body is nothing that the light's view of receivers shows.
    if (isInBody(photon.media)) {
        ledgerAdd(kAccountMissedByTracer, photon.fluxWatts);
        return nothingHit();
    }
    Found nearest = Found(false, 0.0, ivec2(0));
    int faceOfNearest = 0;
    uint causeOfMiss = kAccountUnresolved;
    for (int face = 0; face < viewCount; ++face) {
#ifdef MANY_VIEWS
        viewIndex = face;
#endif
        uint cause;
        Found found = findInView(pointFromEye(photon.positionVs),
                                 directionFromEye(photon.directionVs), cause);
        if (found.isHit && (!nearest.isHit || found.t < nearest.t)) {
            nearest = found;
            faceOfNearest = face;
        }
        if (cause != kAccountUnresolved) causeOfMiss = cause;
    }
    if (!nearest.isHit) {
        ledgerAdd(causeOfMiss, photon.fluxWatts);
        return nothingHit();
    }
#ifdef MANY_VIEWS
    viewIndex = faceOfNearest;
#endif
    vec4 surface = receiverSurfaceAt(nearest.texel);
    vec3 normal = directionToEye(surface.xyz);
    return deliverTo(photon, nearest.t, normal, normal, uint(surface.w));
}

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    if (int(originAt(texel).light) != lightIndex) return;
    Photon photon = photonAt(texel);
    Hit hit = nothingHit();
    if (photon.fate == kFateInFlight) hit = traced(photon);
    storeHit(texel, hit);
}
