// SPDX-License-Identifier: MIT
// trace.raytraced: makes hits of what the processor has found. One thread a photon.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/deliver.glsl"
#include "include/photons/photon_thread.glsl"
#include "include/photons/store_hits.glsl"

uniform sampler2D foundShading;    // xyz: unit, outward; w: material + 1, 0 nothing
uniform sampler2D foundGeometric;  // xyz: the same of the triangle; w: distance, m
#ifdef PHOTON_BEAMS
uniform sampler2D foundTurning0;  // columns of a matrix, 1/m
uniform sampler2D foundTurning1;
uniform sampler2D foundTurning2;
#endif

void threadMain() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    Photon photon = photonAt(texel);
    Hit hit = emptyHit();
    if (photon.fate == kFateInFlight) {
        vec4 shading = texelFetch(foundShading, texel, 0);
        vec4 geometric = texelFetch(foundGeometric, texel, 0);
        if (!isNumber(photon)) {
            ledgerAdd(kAccountNotANumber, vec3(0.0));
        } else if (shading.w > 0.0) {
            hit = deliverTo(photon, geometric.w, shading.xyz, geometric.xyz, uint(shading.w));
#ifdef PHOTON_BEAMS
            mat3 turning = mat3(texelFetch(foundTurning0, texel, 0).xyz,
                                texelFetch(foundTurning1, texel, 0).xyz,
                                texelFetch(foundTurning2, texel, 0).xyz);
            hit.shape = shapeOf(hit.normalVs, turning);
#endif
        } else {
            ledgerAdd(kAccountLeftScene, photon.fluxWatts);
        }
    }
    storeHit(texel, hit);
}
