// SPDX-License-Identifier: MIT
// What tracers that search in order share: what makes of what was found a hit, with the normal and
// the flux that arrives, or an entry in the ledger.
#include "include/deliver.glsl"
#include "include/exit_test.glsl"

// The photon in the space of the view whose layers are asked.
Photon photonInView(Photon photon) {
    photon.positionVs = pointFromEye(photon.positionVs);
    photon.directionVs = directionFromEye(photon.directionVs);
    return photon;
}

// The hit, or, where nothing was met, the account of the reason.
Hit deliver(Photon photon, FirstHit first) {
    Hit hit = nothingMet();
    if (!isNumber(photon)) {
        ledgerAdd(kAccountNotANumber, vec3(0.0));
        return hit;
    }
#ifdef MANY_VIEWS
    viewIndex = first.face;
#endif
    Photon seen = photonInView(photon);
    if (first.hit.layer < 0) {
        ledgerAdd(clipRay(seen.positionVs, seen.directionVs).cause, photon.fluxWatts);
        return hit;
    }
    vec4 surface = texelFetch(layerSurfaces, layerTexel(first.pixel, first.hit.layer), 0);
    LayerSurface layer = layerAt(first.pixel, first.hit.layer);
    uint material = uint(surface.w);
    bool arrives = isReceiver(materialKind(material - 1u));
    Crossing met = Crossing(first.hit.t, surface.xyz, layer.normal);
    if (first.isExit) {
        met = smoothCrossing(seen.positionVs, seen.directionVs, met.t, surface, layer);
    } else {
        vec3 there = seen.positionVs + met.t * seen.directionVs;
        met.shading = normalAtHit(there, surface, layer, arrives);
    }
    return deliverTo(photon, met.t, directionToEye(met.shading), directionToEye(met.geometric),
                     material);
}
