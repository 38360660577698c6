// SPDX-License-Identifier: MIT
// For shaders that send photons on as their light sends them, and as its view alone shows the
// scene: one thread a photon of one light, at the first specular surface of its path.
#include "include/photons/next_photons.glsl"

uniform int lightIndex;

// One that ends here, of which the ledger has the flux: the list has a place for it.
void sendNothing(uint slot, Photon photon, PhotonOrigin origin) {
    photon.fate = kFateEnded;
    photon.fluxWatts = vec3(0.0);
    storeNext(slot, photon, origin);
#ifdef PHOTON_BEAMS
    storeNextBeam(slot, beamFromPoint(mat2(0.0), mat2(0.0)));
#endif
}

// A photon of the list before, and where in the next one it goes on.
struct Arrival {
    uint index;
    uint slot;
    ivec2 texel;
    Photon photon;
    PhotonOrigin origin;
    Hit hit;
};

// To be called once by every thread of the workgroup. False: there is nothing more to do for it.
bool arrivalOfThread(out Arrival arrival) {
    arrival.index = photonOfThread();
    arrival.texel = ivec2(photonTexel(photons, arrival.index));
    bool continues = arrival.index < photons.count &&
                  uint(texelFetch(hitFlux, arrival.texel, 0).w) == kFateSpecular;
    arrival.slot = nextSlot(continues);
    if (lightIndex == 0) countTraced();
    if (!continues) return false;
    arrival.origin = originAt(arrival.texel);
    if (int(lightOfBand(arrival.origin.light)) != lightIndex) return false;
    arrival.hit = hitAt(arrival.texel);
    arrival.photon = photonAt(arrival.texel);
    if (arrival.origin.path != kEmittedPath) {
        // The light's view says nothing of light that has been bent already.
        ledgerAdd(kAccountBounceLimit, arrival.hit.fluxWatts);
        sendNothing(arrival.slot, arrival.photon,
                    nextPhotonOrigin(arrival.origin, arrival.index, false));
        return false;
    }
    ledgerAdd(kAccountEmitted, arrival.hit.fluxWatts);
    return true;
}

// The branch that is followed, one of two; the other one is in the ledger's untraced_branch. Of
// fate kFateNone where there is none: it was in more dielectrics than a stack holds.
struct ChosenBranch {
    Photon photon;
    bool isReflected;
};
ChosenBranch chosenBranch(Photon photon, Hit hit, bool wantsReflected) {
    Branches branches = branchesOf(photon, hit);
    bool refracts = branches.transmitted.fate == kFateInFlight;
    bool reflects = branches.reflected.fate == kFateInFlight;
    if (refracts && reflects) {
        ledgerAdd(kAccountUntracedBranch,
                  (wantsReflected ? branches.transmitted : branches.reflected).fluxWatts);
        refracts = !wantsReflected;
    }
    if (refracts) return ChosenBranch(branches.transmitted, false);
    return ChosenBranch(branches.reflected, true);
}

// Whether a photon that goes on refracted is in a body then, and not beyond a sheet or outside.
bool entersBody(Photon before, Hit hit) {
    return !isOpen(hit.material - 1u) && dot(before.directionVs, hit.normalVs) < 0.0;
}
