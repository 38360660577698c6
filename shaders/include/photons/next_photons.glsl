// SPDX-License-Identifier: MIT
// For shaders that send photons on from where they have hit a specular surface: one thread a photon
// of the list before, and its place in the next one (techniques/photon_lists/next_photons.h).
#include "include/photons/hits.glsl"
#include "include/photons/interaction.glsl"
#include "include/photons/photon_thread.glsl"
#include "include/photons/store_photons.glsl"

layout(std430) readonly buffer NextFirsts {
    uint nextFirsts[];
};
shared uint continuingBits[2];

// To be called once by every thread of the workgroup; the place of this one's photon, where it goes
// on.
uint nextSlot(bool continues) {
    uint local = gl_LocalInvocationIndex;
    if (local < 2u) continuingBits[local] = 0u;
    barrier();
    if (continues) atomicOr(continuingBits[local >> 5u], 1u << (local & 31u));
    barrier();
    uint below = bitfieldExtract(continuingBits[local >> 5u], 0, int(local & 31u));
    uint slot = uint(bitCount(below)) + (local < 32u ? 0u : uint(bitCount(continuingBits[0])));
    return continues ? nextFirsts[workgroupNumber()] + slot : 0u;
}

// Of a photon that is sent on by the thread's.
PhotonOrigin nextPhotonOrigin(PhotonOrigin before, uint index, bool isReflected) {
    return PhotonOrigin(before.cell, before.light, (before.path << 1) | uint(isReflected), index);
}

// Writes a branch of the thread's photon at its place in the next list.
void emitNext(uint slot, ivec2 texel, Photon before, Hit hit, Photon branch, PhotonOrigin origin) {
    storeNext(slot, branch, origin);
#ifdef PHOTON_BEAMS
    bool isReflected = (origin.path & 1u) == 1u;
    storeNextBeam(slot, beamOfBranch(beamAt(texel), before, hit, branch.directionVs, isReflected));
#endif
}
