// SPDX-License-Identifier: MIT
// All of a photon's flux to the texel of the light's view that it lies in. One thread a photon.
#include "include/flux_sum.glsl"
#include "include/hits.glsl"
#include "include/ledger.glsl"
#include "include/photon_thread.glsl"

uniform mat4 eyeToMap;  // from the eye's view space to texels

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    Hit hit = hitAt(ivec2(photonTexel(photons, index)));
    if (hit.fate != kFateReceiver) return;
    ivec2 texel = ivec2(floor((eyeToMap * vec4(hit.positionVs, 1.0)).xy));
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, imageSize(fluxSums).xy))) {
        ledgerAdd(kAccountOffScreen, hit.fluxWatts);
        return;
    }
    fluxAdd(texel, kFluxPart, hit.fluxWatts);
}
