// SPDX-License-Identifier: MIT
// Photons and hits from a list, as texels of the transfer map.
#include "include/thread.glsl"
#include "include/photons/store_hits.glsl"
#include "include/photons/store_photons.glsl"

struct Injected {
    vec4 photonPosition;
    vec4 photonDirection;
    vec4 photonFlux;
    vec4 hitPosition;
    vec4 hitSurface;
    vec4 hitFlux;
};
layout(std430) readonly buffer InjectedPhotons {
    Injected injected[];
};

void main() {
    uint index = threadNumber();
    if (index >= nextPhotons.count) return;
    Injected one = injected[index];
    storeNext(index, unpackPhoton(one.photonPosition, one.photonDirection, one.photonFlux),
              PhotonOrigin(index, 0u, kEmittedPath, 0u, 0u));
#ifdef PHOTON_BEAMS
    storeNextBeam(index, Beam(mat2(one.photonPosition.w), mat2(0.0)));
#endif
    storeHit(ivec2(photonTexel(nextPhotons, index)),
             unpackHit(one.hitPosition, one.hitSurface, one.hitFlux));
}
