// SPDX-License-Identifier: MIT
// For shaders that send photons on from where they have hit a specular surface: one thread a photon
// of the list before, and its place in the next one (techniques/photon_lists/next_photons.h).
#include "include/photons/hits.glsl"
#include "include/photons/interaction.glsl"
#include "include/photons/photon_thread.glsl"
#include "include/photons/store_beams.glsl"
#include "include/photons/store_photons.glsl"

layout(std430) readonly buffer NextFirsts {
    uint nextFirsts[];
};
shared uint continuingBits[2];
#ifdef BRANCHES
layout(std430) readonly buffer NextParting {
    uvec2 nextParting[];
};

// Whether the thread's photon sends on two, the second at the place after the first.
bool isParting() {
    uint local = gl_LocalInvocationIndex;
    return (nextParting[workgroupNumber()][local >> 5u] >> (local & 31u) & 1u) == 1u;
}
#endif

// How many of the workgroup's threads before this one have their bit set.
uint bitsBefore(uint first, uint second) {
    uint local = gl_LocalInvocationIndex;
    uint below = bitfieldExtract(local < 32u ? first : second, 0, int(local & 31u));
    return uint(bitCount(below)) + (local < 32u ? 0u : uint(bitCount(first)));
}

// To be called once by every thread of the workgroup; the place of this one's photon, where it goes
// on.
uint nextSlot(bool continues) {
    uint local = gl_LocalInvocationIndex;
    if (local < 2u) continuingBits[local] = 0u;
    barrier();
    if (continues) atomicOr(continuingBits[local >> 5u], 1u << (local & 31u));
    barrier();
    uint slot = bitsBefore(continuingBits[0], continuingBits[1]);
#ifdef BRANCHES
    uvec2 parting = nextParting[workgroupNumber()];
    slot += bitsBefore(parting.x, parting.y);
#endif
    return continues ? nextFirsts[workgroupNumber()] + slot : 0u;
}

// To be called in one pass of those that send on the same list: notes how long it is.
void countTraced() {
    if (workgroupNumber() == 0u && gl_LocalInvocationIndex == 0u)
        ledgerCountTraced(nextPhotons.count);
}

// Of a photon that is sent on by the thread's.
PhotonOrigin nextPhotonOrigin(PhotonOrigin before, uint index, bool isReflected) {
    return PhotonOrigin(before.cell, before.light, (before.path << 1) | uint(isReflected), index,
                        before.branch);
}

// Writes a branch of the thread's photon at its place in the next list.
void emitNext(uint slot, ivec2 texel, Photon before, Hit hit, Photon branch, PhotonOrigin origin) {
    storeNext(slot, branch, origin);
#ifdef PHOTON_BEAMS
    bool isReflected = (origin.path & 1u) == 1u;
    storeNextBeam(slot, beamOfBranch(beamAt(texel), before, hit, branch.directionVs, isReflected));
#endif
}
