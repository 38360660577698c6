// SPDX-License-Identifier: MIT
// What tracers that search in order share: what makes of what was found a hit, with the normal and
// the flux that arrives, or an entry in the ledger.
#include "common/exit_test.glsl"
#include "common/ledger.glsl"
#include "common/medium.glsl"

// What the list says of a photon that was not on its way, or met nothing.
Hit nothingMet() {
    return Hit(vec3(0.0), 0.0, vec3(0.0), 0u, vec3(0.0), kFateEnded);
}

// Accounts for the photon's flux: what was absorbed on the way, what arrives at a receiver, or why
// nothing was met.
Hit deliver(Photon photon, FirstHit first) {
    Hit hit = nothingMet();
    if (!isNumber(photon)) {
        ledgerAdd(kAccountNotANumber, vec3(0.0));
        return hit;
    }
    if (first.hit.layer < 0) {
        ledgerAdd(clipRay(photon.positionVs, photon.directionVs).cause, photon.fluxWatts);
        return hit;
    }
    vec4 surface = texelFetch(layerSurfaces, ivec3(first.pixel, first.hit.layer), 0);
    LayerSurface layer = layerAt(first.pixel, first.hit.layer);
    hit.material = uint(surface.w);
    bool arrives = isReceiver(materialKind(hit.material - 1u));
    Crossing met = Crossing(first.hit.t, surface.xyz, layer.normal);
    if (first.isExit) {
        met = smoothCrossing(photon.positionVs, photon.directionVs, met.t, surface, layer);
    } else {
        vec3 there = photon.positionVs + met.t * photon.directionVs;
        met.shading = normalAtHit(there, surface, layer, arrives);
    }
    hit.positionVs = photon.positionVs + met.t * photon.directionVs;
    hit.distanceMeters = met.t;
    hit.normalVs =
        arrives
            ? receiverNormal(hit.positionVs, photon.directionVs, met.shading, met.geometric)
            : bendingNormal(photon.directionVs, met.shading, met.geometric, hit.material,
                            photon.media);
    // Asking whether there is a medium would cost more than adding its zeros.
    vec3 left = transmittanceOver(extinctionAround(photon.media), hit.distanceMeters);
    hit.fluxWatts = photon.fluxWatts * left;
    ledgerAdd(kAccountAbsorbed, photon.fluxWatts * (1.0 - left));
    hit.fate = arrives ? kFateReceiver : kFateSpecular;
    if (arrives) ledgerAdd(kAccountArrived, hit.fluxWatts);
    return hit;
}
