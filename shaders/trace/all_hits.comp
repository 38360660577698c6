// SPDX-License-Identifier: MIT
// trace.all_hits: the hits of one slot, a thread a photon; slot 0 holds the first hit, the others the
// receivers that the ray would hit beyond it.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/photon_thread.glsl"
#include "include/photons/store_hits.glsl"
#include "include/photons/next_photon_list.glsl"
#include "include/photons/traced_photon.glsl"

uniform int slot;

// The surface number `wanted` along the ray; past the first only receivers count, and none where
// the first is specular: there the light does go on elsewhere.
FirstHit hitNumber(Photon photon, int wanted) {
    FirstHit last = noHit();
    if (!isNumber(photon)) return last;
    RaySegment segment = clipRay(photon.positionVs, photon.directionVs);
    if (!segment.visible) return last;
    TracedRay ray = tracedRay(photon.positionVs, photon.directionVs, photon.media);
    int steps = stepCount(segment, trace_all_hits_minimum, trace_all_hits_steps);
    int number = -1;
    FirstHit pending = noHit();  // the next step may know a nearer one
    for (int i = 0; i <= steps; ++i) {
        FirstHit found = noHit();
        if (i < steps) found = hitOfStep(segment, ray, i, steps);
        bool isNew = found.hit.layer >= 0;
        if (number >= 0 && isNew) {
            // Neighbouring steps may hit the same surface.
            float step = segment.farT - segment.nearT;
            isNew = found.hit.t > last.hit.t + step / float(steps);
            uint material = layerAt(found.pixel, found.hit.layer).material;
            isNew = isNew && isReceiver(materialKind(material - 1u));
        }
        if (pending.hit.layer >= 0) {
            if (isNew && found.hit.t < pending.hit.t) pending = found;
            last = pending;
            pending = noHit();
            ++number;
            if (number == wanted) return last;
            uint material = layerAt(last.pixel, last.hit.layer).material;
            if (!isReceiver(materialKind(material - 1u))) return noHit();
        } else if (isNew) {
            pending = found;
        }
    }
    return noHit();
}

void threadMain() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    Photon photon = photonAt(texel);
    Hit hit = emptyHit();
    if (photon.fate == kFateInFlight) {
        FirstHit found = hitNumber(photon, slot);
        if (slot == 0 || found.hit.layer >= 0) hit = deliver(photon, found);
        bool isLast = slot == trace_all_hits_slots - 1;
        if (isLast && hit.fate == kFateReceiver) ledgerAdd(kAccountFullSlots, hit.fluxWatts);
    }
    uint next = uint(slot) * photons.count + index;
    storeHit(ivec2(photonTexel(nextPhotons, next)), hit);
}
