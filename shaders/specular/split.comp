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
    bool isParted = false;
    bool isReflected = branches.transmitted.fate != kFateInFlight;
#ifdef BRANCHES
    uint number = branchNumberOf(origin);
    uint room = branchRoomOf(origin);
    origin.branch = branchOf(number, room);
    uint forReflected = 0u;
    isParted = isParting();
    if (isParted) {
        float reflected = sumOf(branches.reflected.fluxWatts);
        float all = sumOf(branches.transmitted.fluxWatts) + reflected;
        forReflected = reflectedRoom(room, all > 0.0 ? reflected / all : 0.0);
    }
#endif
    if (areBoth && !isParted) {
        isReflected =
            sumOf(branches.reflected.fluxWatts) > sumOf(branches.transmitted.fluxWatts);
        ledgerAdd(kAccountUntracedBranch, isReflected ? branches.transmitted.fluxWatts
                                                      : branches.reflected.fluxWatts);
    }
    // In a loop and not one after the other, which all threads would wait for.
    uint i = 0u;
    do {
        bool isSecond = isParted ? i == 1u : isReflected;
        PhotonOrigin next = nextPhotonOrigin(origin, index, isSecond);
#ifdef BRANCHES
        if (isParted) {
            next.branch = isSecond ? branchOf(number + room - forReflected, forReflected)
                                   : branchOf(number, room - forReflected);
        }
#endif
        emitNext(slot + i, texel, before, hit,
                 isSecond ? branches.reflected : branches.transmitted, next);
    } while (++i < (isParted ? 2u : 1u));
}
