// SPDX-License-Identifier: MIT
// Both Fresnel branches of photons that have hit a specular surface: one thread a photon. The first
// half of the next list are the transmitted branches, or the only ones, the second half the
// reflected ones. Without room for both, one is drawn by its share, and carries all of the flux.
#include "include/photons/next_photons.glsl"

uniform int splits;  // the list has a second half
uniform uint seedLow;
uniform uint seedHigh;

// A hash of a number (PCG, Jarzynski and Olano 2020).
uint hashOf(uint number) {
    uint state = number * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// [0, 1), from the seed and where the photon comes from: not from its place in a list.
float uniformOf(PhotonOrigin origin) {
    uint number = hashOf(hashOf(seedLow) + seedHigh);
    number = hashOf(number + origin.path);
    number = hashOf(number + origin.cell);
    number = hashOf(number + origin.light);
    return float(number >> 8u) / 16777216.0;
}

void main() {
    uint index = photonOfThread();
    ivec2 texel = ivec2(photonTexel(photons, index));
    bool continues = index < photons.count &&
                  uint(texelFetch(hitFlux, texel, 0).w) == kFateSpecular;
    uint slot = nextSlot(continues);
    if (!continues) return;
    Hit hit = hitAt(texel);
    PhotonOrigin origin = originAt(texel);
    if (origin.path == kEmittedPath) ledgerAdd(kAccountEmitted, hit.fluxWatts);
    Photon before = photonAt(texel);
    Branches branches = branchesOf(before, hit);
    Photon photon = branches.transmitted;
    bool areBoth = photon.fate == kFateInFlight && branches.reflected.fate == kFateInFlight;
    bool isReflected = photon.fate != kFateInFlight;
    if (areBoth && splits == 0) {
        vec3 whole = branches.transmitted.fluxWatts + branches.reflected.fluxWatts;
        float all = whole.r + whole.g + whole.b;
        vec3 part = branches.reflected.fluxWatts;
        float share = all > 0.0 ? (part.r + part.g + part.b) / all : 0.0;
        isReflected = uniformOf(origin) < share;
        branches.reflected.fluxWatts = whole;
        branches.transmitted.fluxWatts = whole;
        photon = branches.transmitted;
    }
    emitNext(slot, texel, before, hit, isReflected ? branches.reflected : photon,
           nextPhotonOrigin(origin, index, isReflected));
    if (splits == 0) return;
    // Without a second branch the place is of nobody; its numbers are the only branch's, so that
    // they are numbers.
    Photon second = areBoth ? branches.reflected
                            : Photon(vec3(0.0), 0.0, vec3(0.0), kFateNone, vec3(0.0), 0u);
    emitNext(nextPhotons.count / 2u + slot, texel, before, hit, second,
           nextPhotonOrigin(origin, index, true));
}
