// SPDX-License-Identifier: MIT
// What photons do where they have hit a specular surface: one thread a photon.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/next_photons.glsl"

void threadMain() {
    uint index = photonOfThread();
    ivec2 texel = ivec2(photonTexel(photons, index));
    bool continues = index < photons.count &&
                  uint(texelFetch(hitFlux, texel, 0).w) == kFateSpecular;
    uint slot = nextSlot(continues);
    countTraced();
    if (!continues) return;
    Hit hit = hitAt(texel);
    PhotonOrigin origin = originAt(texel);
    if (origin.path == kEmittedPath) ledgerAdd(kAccountEmitted, hit.fluxWatts);
    Photon photon = photonAt(texel);
    Branches branches = branchesOf(photon, hit);
    bool goesThrough = branches.transmitted.fate == kFateInFlight;
    if (goesThrough && branches.reflected.fate == kFateInFlight)
        ledgerAdd(kAccountUntracedBranch, branches.reflected.fluxWatts);
    if (goesThrough) {
        emitNext(slot, texel, photon, hit, branches.transmitted, nextPhotonOrigin(origin, index, false));
    } else {
        emitNext(slot, texel, photon, hit, branches.reflected, nextPhotonOrigin(origin, index, true));
    }
}
