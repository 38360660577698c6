// SPDX-License-Identifier: MIT
// What tracers that search in order share: what makes of what was found a hit, with the normal and
// the flux that arrives, or an entry in the ledger.
#include "include/photons/deliver.glsl"
#include "include/views/exit_test.glsl"

#ifdef PHOTON_BEAMS
mat3 turningToEye(mat3 turning) {
#ifdef OTHER_VIEW
    mat3 toEye = transpose(mat3(view.fromEye));
    return toEye * turning * transpose(toEye);
#else
    return turning;
#endif
}
#endif

// The photon in the space of the view whose layers are asked.
Photon photonInView(Photon photon) {
    photon.positionVs = pointFromEye(photon.positionVs);
    photon.directionVs = directionFromEye(photon.directionVs);
    return photon;
}

// How a surface that was hit first is crossed; `seen`: the photon in its view's space.
Crossing crossingOf(Photon seen, FirstHit first, out uint material) {
    vec4 surface = texelFetch(layerSurfaces, layerTexel(first.pixel, first.hit.layer), 0);
    LayerSurface layer = layerAt(first.pixel, first.hit.layer);
    material = uint(surface.w);
    Crossing crossing = Crossing(first.hit.t, surface.xyz, layer.normal, mat3(0.0));
    if (first.isExit) {
        crossing = smoothCrossing(seen.positionVs, seen.directionVs, crossing.t, surface, layer);
    } else if (!isReceiver(materialKind(material - 1u))) {
        // The normal of one pixel alone would send all photons that hit it the same way. A receiver
        // sends the light nowhere: its pixel's normal will do.
        vec3 there = seen.positionVs + crossing.t * seen.directionVs;
        SmoothSurface around = smoothSurfaceAt(there, surface, layer);
        crossing.shading = around.normal;
        crossing.turning = around.curving;
    }
    return crossing;
}

// The hit, or, where nothing was hit, the account of the reason.
Hit deliver(Photon photon, FirstHit first) {
    Hit hit = emptyHit();
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
    uint material;
    Crossing crossing = crossingOf(seen, first, material);
    hit = deliverTo(photon, crossing.t, directionToEye(crossing.shading),
                    directionToEye(crossing.geometric), material);
#ifdef PHOTON_BEAMS
    if (hit.fate == kFateSpecular) hit.shape = shapeOf(hit.normalVs, turningToEye(crossing.turning));
#endif
    return hit;
}
