// SPDX-License-Identifier: MIT
// trace.secant: one thread a photon of one generator.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/photon_thread.glsl"
#include "include/surfaces/generators.glsl"
#include "include/photons/store_hits.glsl"
#include "tracing/secant.glsl"

uniform int generatorIndex;

void threadMain() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    Photon photon = photonAt(texel);
    if (generators.count.x > 1u && generatorOf(photon.positionVs) != generatorIndex) return;
    Hit hit = emptyHit();
    if (photon.fate == kFateInFlight) {
        bool isCut;
        FirstHit first = searchAround(photon, trace_secant_stride, trace_secant_max_steps,
                                      trace_secant_refinements, isCut);
        if (first.hit.layer < 0 && isCut && isNumber(photon)) {
            ledgerAdd(kAccountBeyondLastLayer, photon.fluxWatts);
        } else {
            hit = deliver(photon, first);
        }
    }
    storeHit(texel, hit);
}
