// SPDX-License-Identifier: MIT
// Accounts for first hits that were found on tiles of the screen (K06, section 6), as the tracer of
// the whole screen does when it finds them. One thread a photon.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/photon_thread.glsl"
#include "include/photons/deliver.glsl"
#include "include/views/ray_segment.glsl"

layout(rgba32f) readonly uniform image2D hitPosition;
layout(rgba32f) readonly uniform image2D hitSurface;
layout(rgba32f) readonly uniform image2D hitFlux;

void threadMain() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    Photon photon = photonAt(texel);
    if (photon.fate != kFateInFlight) return;
    if (!isNumber(photon)) {
        ledgerAdd(kAccountNotANumber, vec3(0.0));
        return;
    }
    Hit hit = unpackHit(imageLoad(hitPosition, texel), imageLoad(hitSurface, texel),
                        imageLoad(hitFlux, texel));
    bool arrives = hit.fate == kFateReceiver;
    if (!arrives && hit.fate != kFateSpecular) {
        ledgerAdd(clipRay(photon.positionVs, photon.directionVs).cause, photon.fluxWatts);
        return;
    }
    vec3 left = transmittanceOver(extinctionAround(photon.media), hit.distanceMeters);
    accountForHit(photon, left, hit.fluxWatts, arrives);
}
