// SPDX-License-Identifier: MIT
// What tracers that search in order share: what makes of what was found a hit, with the normal and
// the flux that arrives, or an entry in the ledger.
#include "include/deliver.glsl"
#include "include/exit_test.glsl"

// The hit, or, where nothing was hit, the account of the reason.
Hit deliver(Photon photon, FirstHit first) {
    Hit hit = nothingHit();
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
    uint material = uint(surface.w);
    bool arrives = isReceiver(materialKind(material - 1u));
    Crossing crossing = Crossing(first.hit.t, surface.xyz, layer.normal);
    if (first.isExit) {
        crossing = smoothCrossing(photon.positionVs, photon.directionVs, crossing.t, surface, layer);
    } else {
        vec3 there = photon.positionVs + crossing.t * photon.directionVs;
        crossing.shading = normalAtHit(there, surface, layer, arrives);
    }
    return deliverTo(photon, crossing.t, crossing.shading, crossing.geometric, material);
}
