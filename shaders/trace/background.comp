// SPDX-License-Identifier: MIT
// trace.background: where a photon's ray meets what its light sees, by iteration in the light's
// depths (WD08, section 3; SP05). One thread a photon of one light.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/deliver.glsl"
#include "include/photons/photon_thread.glsl"
#include "include/views/plane_search.glsl"
#include "include/photons/store_hits.glsl"
#include "tracing/specular_ahead.glsl"
#include "include/views/seen_receiver.glsl"

uniform int lightIndex;

SeenPlane planeAt(ivec2 texel) {
    SeenPlane plane;
    plane.texel = texel;
    plane.depth = max(receiverAt(texel).x, 0.0);
    plane.exists = plane.depth > 0.0;
    plane.normal = receiverSurfaceAt(texel).xyz;
    plane.middle = viewPoint(vec2(texel) + 0.5, plane.depth);
    return plane;
}

Found findInView(vec3 origin, vec3 direction, out uint cause) {
    RaySegment segment = clipRay(origin, direction);
    cause = segment.cause;
    if (!segment.visible) return Found(false, 0.0, ivec2(0));
    // SP05 starts with what the light's own ray would have hit.
    SeenPlane straight = planeAt(clampedTexel(origin));
    float start = straight.exists ? distance(straight.middle, origin) : segment.farT;
    PlaneSearch how =
        PlaneSearch(trace_background_iterations,
                    trace_background_step == trace_background_step_distance,
                    trace_background_steps, trace_background_refinements);
    Found found = iterate(origin, direction, start, segment, how);
    if (trace_background_steps == 0) {
        // An iteration that has ended nowhere.
        if (cause == kAccountUnresolved) cause = kAccountMissedByTracer;
        return found;
    }
    // Iteration may have jumped over what lies before.
    bool endsBehind;
    Found nearer =
        search(origin, direction, segment, found.isHit ? found.t : 3.0e38, how, endsBehind);
    if (nearer.isHit) return nearer;
    if (!found.isHit && endsBehind) cause = kAccountHiddenInMap;
    return found;
}

Hit traced(Photon photon, ivec2 texel) {
    if (!isNumber(photon)) {
        ledgerAdd(kAccountNotANumber, vec3(0.0));
        return emptyHit();
    }
    // The far side of a body is nothing that the light's view of receivers shows.
    if (isInBody(photon.media)) {
        ledgerAdd(kAccountMissedByTracer, photon.fluxWatts);
        return emptyHit();
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
    if (isStopped(texel, nearest.isHit ? nearest.t : 3.0e38)) return stoppedHit(photon, texel);
    if (!nearest.isHit) {
        ledgerAdd(causeOfMiss, photon.fluxWatts);
        return emptyHit();
    }
#ifdef MANY_VIEWS
    viewIndex = faceOfNearest;
#endif
    vec4 surface = receiverSurfaceAt(nearest.texel);
    vec3 normal = directionToEye(surface.xyz);
    return deliverTo(photon, nearest.t, normal, normal, uint(surface.w));
}

void threadMain() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    if (int(lightOfBand(originAt(texel).light)) != lightIndex) return;
    Photon photon = photonAt(texel);
    Hit hit = emptyHit();
    if (photon.fate == kFateInFlight) hit = traced(photon, texel);
    storeHit(texel, hit);
}
