// SPDX-License-Identifier: MIT
// The photons that the walk stores, one after the other: that of a square carries all of its flux,
// as wide as the square. One thread a photon.
//   PHOTONS  what they were before they arrived; else the hits
#include "driver/hierarchical.glsl"
#include "include/photons/hits.glsl"
#include "include/photons/photons.glsl"
#include "include/thread.glsl"

layout(std430) readonly buffer StoredPhotons {
    StoredPhoton storedPhotons[];
};
layout(std430) readonly buffer StoredList {
    PhotonList storedList;
};
#ifdef PHOTONS
layout(rgba32f) writeonly uniform image2D storedPosition;
layout(rgba32f) writeonly uniform image2D storedDirection;
layout(rgba32f) writeonly uniform image2D storedFlux;
layout(rgba32ui) writeonly uniform uimage2D storedOrigin;
#ifdef PHOTON_BEAMS
layout(rgba32f) writeonly uniform image2D storedPlace;
layout(rgba32f) writeonly uniform image2D storedTurn;
#endif
#else
layout(rgba32f) writeonly uniform image2D storedHitPosition;
layout(rgba32f) writeonly uniform image2D storedHitSurface;
layout(rgba32f) writeonly uniform image2D storedHitFlux;
#endif

void main() {
    uint index = threadNumber();
    if (index >= storedList.count) return;
    StoredPhoton stored = storedPhotons[index];
    ivec2 from = ivec2(photonTexel(photons, stored.photon));
    ivec2 to = ivec2(photonTexel(storedList, index));
#ifdef PHOTONS
    imageStore(storedPosition, to, texelFetch(photonPosition, from, 0));
    imageStore(storedDirection, to, texelFetch(photonDirection, from, 0));
    imageStore(storedFlux, to, texelFetch(photonFlux, from, 0));
    imageStore(storedOrigin, to, texelFetch(photonOrigin, from, 0));
#ifdef PHOTON_BEAMS
    float width = float(1u << stored.level);
    imageStore(storedPlace, to, width * texelFetch(photonBeamPlace, from, 0));
    imageStore(storedTurn, to, width * texelFetch(photonBeamTurn, from, 0));
#endif
#else
    vec4 flux = texelFetch(hitFlux, from, 0);
    if (stored.node != 0u) flux.rgb = nodes[stored.node - 1u].flux.rgb;
    imageStore(storedHitPosition, to, texelFetch(hitPosition, from, 0));
    imageStore(storedHitSurface, to, texelFetch(hitSurface, from, 0));
    imageStore(storedHitFlux, to, flux);
#endif
}
