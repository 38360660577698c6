// SPDX-License-Identifier: MIT
// Photons that were still on their way when the bounces ended. A thread a photon of the last list.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/hits.glsl"
#include "include/photons/photon_thread.glsl"

void threadMain() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    vec4 flux = texelFetch(hitFlux, ivec2(photonTexel(photons, index)), 0);
    if (uint(flux.w) == kFateSpecular) ledgerAdd(kAccountBounceLimit, flux.rgb);
}
