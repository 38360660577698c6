// SPDX-License-Identifier: MIT
// trace.march_compute: one thread a photon.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/photon_thread.glsl"
#include "include/photons/store_hits.glsl"
#include "trace/march.glsl"

void threadMain() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    Photon photon = photonAt(texel);
    Hit hit = emptyHit();
    FirstHit first = noHit();
    if (photon.fate == kFateInFlight) {
        first = march(photon, trace_march_compute_minimum, trace_march_compute_steps);
        hit = deliver(photon, first);
    }
    storeOrder(texel, photon, first, hit, uint(first.step) + 1u);
    storeHit(texel, hit);
}
