// SPDX-License-Identifier: MIT
// What makes of a surface that a photon reaches a hit, with the normal and the flux that arrives:
// what every tracer ends with.
#include "include/photons/ledger.glsl"
#include "include/photons/medium.glsl"
#include "include/surfaces/specular.glsl"
#include "include/photons/transfer_map.glsl"

// What the list says of a photon that was not on its way, or hit nothing.
Hit emptyHit() {
    return Hit(vec3(0.0), 0.0, vec3(0.0), 0u, vec3(0.0), kFateEnded, vec3(0.0));
}

// The normal of a receiver: the shading normal, unless that takes the eye or the arriving light for
// being on the other side than the triangle does.
vec3 receiverNormal(vec3 positionVs, vec3 direction, vec3 shading, vec3 geometric) {
    bool sameLight = (dot(direction, shading) < 0.0) == (dot(direction, geometric) < 0.0);
    bool sameEye = (dot(positionVs, shading) < 0.0) == (dot(positionVs, geometric) < 0.0);
    return sameLight && sameEye ? shading : geometric;
}

// Accounts for what was absorbed on the way, of which `left` is left, and what arrives at a receiver.
void accountForHit(Photon photon, vec3 left, vec3 arrivingWatts, bool arrives) {
    ledgerAdd(kAccountAbsorbed, photon.fluxWatts * (1.0 - left));
    if (arrives) ledgerAdd(kAccountArrived, arrivingWatts);
}

// The hit at a distance, accounted for. `shading`, `geometric`:
// unit, outward; `material`: index + 1.
Hit deliverTo(Photon photon, float distance, vec3 shading, vec3 geometric, uint material) {
    Hit hit = emptyHit();
    bool arrives = isReceiver(materialKind(material - 1u));
    hit.material = material;
    hit.positionVs = photon.positionVs + distance * photon.directionVs;
    hit.distanceMeters = distance;
    hit.normalVs =
        arrives ? receiverNormal(hit.positionVs, photon.directionVs, shading, geometric)
                : bendingNormal(photon.directionVs, shading, geometric, material, photon.media);
    // Asking whether there is a medium would cost more than adding its zeros.
    vec3 left = transmittanceOver(extinctionAround(photon.media), hit.distanceMeters);
    hit.fluxWatts = photon.fluxWatts * left;
    hit.fate = arrives ? kFateReceiver : kFateSpecular;
    if (!arrives && hit.normalVs != shading)
        ledgerAdd(kAccountTriangleNormal, hit.fluxWatts);
    accountForHit(photon, left, hit.fluxWatts, arrives);
    return hit;
}
