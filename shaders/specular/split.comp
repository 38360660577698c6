// SPDX-License-Identifier: MIT
// Both Fresnel branches of photons that have hit a specular surface: one thread a photon. Where
// there is room for one alone it is the stronger one; the other is in the ledger's untraced_branch.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/next_photons.glsl"
#ifdef BRANCHES
#include "include/photons/branches.glsl"
#endif

float sumOf(vec3 v) { return v.r + v.g + v.b; }

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
    Photon before = photonAt(texel);
    Branches branches = branchesOf(before, hit);
    bool areBoth = branches.transmitted.fate == kFateInFlight &&
                   branches.reflected.fate == kFateInFlight;
#ifdef BRANCHES
    uint number = branchNumberOf(origin);
    uint room = branchRoomOf(origin);
    origin.branch = branchOf(number, room);
    if (isParting()) {
        float reflected = sumOf(branches.reflected.fluxWatts);
        float all = sumOf(branches.transmitted.fluxWatts) + reflected;
        uint forReflected = reflectedRoom(room, all > 0.0 ? reflected / all : 0.0);
        PhotonOrigin first = nextPhotonOrigin(origin, index, false);
        PhotonOrigin second = nextPhotonOrigin(origin, index, true);
        first.branch = branchOf(number, room - forReflected);
        second.branch = branchOf(number + room - forReflected, forReflected);
        emitNext(slot, texel, before, hit, branches.transmitted, first);
        emitNext(slot + 1u, texel, before, hit, branches.reflected, second);
        return;
    }
#endif
    bool isReflected = branches.transmitted.fate != kFateInFlight;
    if (areBoth) {
        isReflected =
            sumOf(branches.reflected.fluxWatts) > sumOf(branches.transmitted.fluxWatts);
        ledgerAdd(kAccountUntracedBranch, isReflected ? branches.transmitted.fluxWatts
                                                      : branches.reflected.fluxWatts);
    }
    if (isReflected) {
        emitNext(slot, texel, before, hit, branches.reflected, nextPhotonOrigin(origin, index, true));
    } else {
        emitNext(slot, texel, before, hit, branches.transmitted,
                 nextPhotonOrigin(origin, index, false));
    }
}
