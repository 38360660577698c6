// SPDX-License-Identifier: MIT
// What becomes of a photon where it has hit a specular surface (K06, section 2.3).
#include "include/photons/ledger.glsl"
#include "include/surfaces/specular.glsl"
#ifdef PHOTON_BEAMS
#include "include/photons/beam.glsl"
#endif

// The branches: fate kFateNone where there is none. Their flux is the photon's, less what a mirror
// absorbs and what enters a dielectric inside of more others than a stack holds, which both go to
// the ledger here.
struct Branches {
    Photon transmitted;
    Photon reflected;
};

Branches branchesOf(Photon photon, Hit hit) {
    uint surface = hit.material - 1u;
    MaterialData data = materials[surface];
    photon.positionVs = hit.positionVs;
    photon.fluxWatts = hit.fluxWatts;
    photon.fate = kFateInFlight;
    // The hit's normal has the triangle's side: see bendingNormal.
    bool enters = dot(photon.directionVs, hit.normalVs) < 0.0;
    photon.media = withLeftSide(photon.media, kLeftNone);
    Branches branches = Branches(photon, photon);
    if (uint(data.albedo.w) == kMaterialMirror) {
        branches.transmitted.fate = kFateNone;
        branches.transmitted.fluxWatts = vec3(0.0);
        branches.reflected.directionVs = normalize(reflect(photon.directionVs, hit.normalVs));
        vec3 reflectance = tinted(data.albedo.rgb);
        ledgerAdd(kAccountAbsorbed, photon.fluxWatts * (1.0 - reflectance));
        branches.reflected.fluxWatts *= reflectance;
        if (isOpen(surface)) {
            branches.reflected.media =
                withLeftSide(photon.media, enters ? kLeftOutside : kLeftInside);
        }
        return branches;
    }
    vec2 indices = indicesAt(hit.material, photon.media, enters);
    Interface interaction = interactAt(photon.directionVs, hit.normalVs, indices.x, indices.y);
    // Where one dielectric ends inside of another nothing is reflected, to the last bit.
    if (indices.x == indices.y) interaction.reflectance = 0.0;
    branches.reflected.directionVs = interaction.reflected;
    branches.reflected.fluxWatts *= interaction.reflectance;
    branches.transmitted.fluxWatts *= 1.0 - interaction.reflectance;
    branches.transmitted.directionVs = interaction.refracted;
    if (interaction.reflectance <= 0.0) branches.reflected.fate = kFateNone;
    if (interaction.reflectance >= 1.0) {
        branches.transmitted.fate = kFateNone;
    } else if (!enters) {
        branches.transmitted.media = leaveMedium(photon.media, hit.material);
    } else if (canEnter(photon.media, hit.material)) {
        branches.transmitted.media = enterMedium(photon.media, hit.material);
    } else {
        ledgerAdd(kAccountNestingLimit, branches.transmitted.fluxWatts);
        branches.transmitted.fate = kFateNone;
    }
    return branches;
}

#ifdef PHOTON_BEAMS
// The beam of a branch that goes on in `direction`.
Beam beamOfBranch(Beam beam, Photon before, Hit hit, vec3 direction, bool isReflected) {
    float eta = 0.0;
    if (!isReflected) {
        bool enters = dot(before.directionVs, hit.normalVs) < 0.0;
        vec2 indices = indicesAt(hit.material, before.media, enters);
        eta = indices.x / indices.y;
    }
    return propagatedBeam(beam, before.directionVs, hit.distanceMeters, hit.normalVs, hit.shape,
                      direction, eta);
}
#endif
