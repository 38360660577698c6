// SPDX-License-Identifier: MIT
// Photons from a list, as texels of the transfer map. INJECT_HITS: their hits instead, since OpenGL
// grants a program no more than eight images.
#include "include/thread.glsl"
#include "include/photons/next_photon_list.glsl"
#ifdef INJECT_HITS
#include "include/photons/store_hits.glsl"
#else
#include "include/photons/store_beams.glsl"
#include "include/photons/store_photons.glsl"
#endif

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
#ifdef INJECT_HITS
    storeHit(ivec2(photonTexel(nextPhotons, index)),
             unpackHit(one.hitPosition, one.hitSurface, one.hitFlux));
#else
    storeNext(index, unpackPhoton(one.photonPosition, one.photonDirection, one.photonFlux),
              PhotonOrigin(index, 0u, kEmittedPath, 0u, 0u));
#ifdef PHOTON_BEAMS
    storeNextBeam(index, beamFromPoint(mat2(one.photonPosition.w), mat2(0.0)));
#endif
#endif
}
