// SPDX-License-Identifier: MIT
// Photons that were still on their way when the bounces ended. A thread a photon of the last list.
#include "include/hits.glsl"
#include "include/ledger.glsl"
#include "include/photon_thread.glsl"

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    vec4 flux = texelFetch(hitFlux, ivec2(photonTexel(photons, index)), 0);
    if (uint(flux.w) == kFateSpecular) ledgerAdd(kAccountBounceLimit, flux.rgb);
}
