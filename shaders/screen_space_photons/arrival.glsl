// SPDX-License-Identifier: MIT
// Where a photon arrives, and by its beam where its neighbours would.
#include "include/hits.glsl"
#include "include/photon_thread.glsl"
#include "include/view.glsl"

// A beam that grazes is taken as if it came at this sine at least, which bounds what it covers.
const float kLeastArrivalSlant = 0.1;

struct Arrival {
    vec3 position;  // of the view, m
    vec3 normal;    // unit, outward
    vec3 direction;
    mat2x3 beside;  // to where the next cells' light arrives, along u and v, m
    vec3 flux;      // W
    uint material;  // index + 1
    uint path;
};

mat2x3 fromEye(mat2x3 offsets) {
    return mat2x3(directionFromEye(offsets[0]), directionFromEye(offsets[1]));
}

Arrival arrivalOf(ivec2 texel) {
    Hit hit = hitAt(texel);
    Photon photon = photonAt(texel);
    mat2x3 beside = beamOnPlane(beamAt(texel), photon.directionVs, hit.distanceMeters, hit.normalVs,
                                kLeastArrivalSlant);
    return Arrival(pointFromEye(hit.positionVs), directionFromEye(hit.normalVs),
                   directionFromEye(photon.directionVs), fromEye(beside), hit.fluxWatts,
                   hit.material, originAt(texel).path);
}
