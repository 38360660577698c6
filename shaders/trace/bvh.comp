// SPDX-License-Identifier: MIT
// trace.bvh: the first triangle on each photon's ray. One thread a photon.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/deliver.glsl"
#include "include/photons/photon_thread.glsl"
#include "include/photons/store_hits.glsl"
#include "include/surfaces/bvh.glsl"
#include "include/surfaces/side_rule.glsl"

TracedRay photonRay;       // its media; directions are local
float photonReach = 0.0;  // within which the surface that it has left may lie, m

bool isSurfaceHit(BvhRay ray, uint triangle, vec3 normal, float height) {
    return isFacing(photonRay, bvhSources[triangle].material, normal, height, photonReach);
}

Hit hitOf(Photon photon) {
    BvhRay ray = bvhRay(photon.positionVs, photon.directionVs);
    photonRay = tracedRay(ray.origin, ray.direction, photon.media);
    // Where an open mirror sent it on may be known to a pixel alone.
    photonReach = localRounding + 2.0 * pixelFootprint(abs(photon.positionVs.z));
    BvhHit found = traceBvh(ray, 3.0e38);
    if (found.triangle == kBvhNone) {
        ledgerAdd(kAccountLeftScene, photon.fluxWatts);
        return emptyHit();
    }
    PointOnTriangle point = pointOfHit(ray, found);
    float size = max(length(point.normal), 1e-12);
    vec3 shading = localToEye(shadingNormal(point.normal, point.geometric));
    Hit hit = deliverTo(photon, found.distance, shading, localToEye(point.geometric),
                        bvhSources[found.triangle].material);
#ifdef PHOTON_BEAMS
    mat3 toEye = transpose(mat3(localFromEye));
    hit.shape = shapeFrom(hit.normalVs, toEye * point.places, toEye * point.turns / size);
#endif
    return hit;
}

void threadMain() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    Photon photon = photonAt(texel);
    Hit hit = emptyHit();
    if (photon.fate == kFateInFlight) {
        if (isNumber(photon)) {
            hit = hitOf(photon);
        } else {
            ledgerAdd(kAccountNotANumber, vec3(0.0));
        }
    }
    storeHit(texel, hit);
}
