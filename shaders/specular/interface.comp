// SPDX-License-Identifier: MIT
// What photons do where they have hit a specular surface: one thread a photon.
#include "include/next_photons.glsl"

void main() {
    uint index = photonOfThread();
    ivec2 texel = ivec2(photonTexel(photons, index));
    bool goesOn = index < photons.count &&
                  uint(texelFetch(hitFlux, texel, 0).w) == kFateSpecular;
    uint slot = nextSlot(goesOn);
    if (!goesOn) return;
    Hit hit = hitAt(texel);
    PhotonOrigin origin = originAt(texel);
    if (origin.path == kEmittedPath) ledgerAdd(kAccountEmitted, hit.fluxWatts);
    Photon photon = photonAt(texel);
    Branches branches = branchesOf(photon, hit);
    bool goesThrough = branches.transmitted.fate == kFateInFlight;
    if (goesThrough && branches.reflected.fate == kFateInFlight)
        ledgerAdd(kAccountUntracedBranch, branches.reflected.fluxWatts);
    if (goesThrough) {
        sendOn(slot, texel, photon, hit, branches.transmitted, originOfNext(origin, index, false));
    } else {
        sendOn(slot, texel, photon, hit, branches.reflected, originOfNext(origin, index, true));
    }
}
