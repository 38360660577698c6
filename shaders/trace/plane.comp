// SPDX-License-Identifier: MIT
// trace.plane: the nearest flat receiver on each photon's ray. One thread a photon.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/deliver.glsl"
#include "include/photons/photon_thread.glsl"
#include "include/photons/store_hits.glsl"
#include "tracing/specular_ahead.glsl"
#include "techniques/trace/plane_face.h"

layout(std430) readonly buffer FlatFaces {
    FlatFace flatFaces[];
};
uniform int faceCount;
uniform uint missAccount;

// What coordinates of some size may be off by, as a share of it: a few units of the last place.
const float kRounding = 5e-7;
// Cosines to a plane below this are rounding of its normal.
const float kParallel = 1e-6;

// Where the ray hits a face, m; below 0: nowhere.
float intersectFace(FlatFace face, vec3 origin, vec3 direction) {
    const float nowhere = -1.0;
    float closing = dot(face.normal.xyz, direction);
    if (!(abs(closing) > kParallel)) return nowhere;
    vec3 toCorner = face.corner.xyz - origin;
    float height = dot(face.normal.xyz, toCorner);
    float t = height / closing;
    // A photon that starts in the plane, at glass that stands on a floor or at a mirror that lies
    // on it, hits the plane if it goes to its back, and has come from it otherwise.
    float size = max(length(face.corner.xyz), length(origin));
    bool startsInPlane = abs(height) <= kRounding * size;
    if (startsInPlane) t = closing < 0.0 ? max(t, 0.0) : nowhere;
    if (!(t >= 0.0)) return nowhere;
    vec3 on = t * direction - toCorner;
    float u = dot(face.acrossU.xyz, on);
    float v = dot(face.acrossV.xyz, on);
    // Nothing slips through between two faces that hit.
    vec2 slack = kRounding * (size + t) * vec2(face.acrossU.w, face.acrossV.w);
    bool isInside = abs(u - 0.5) <= 0.5 + slack.x && abs(v - 0.5) <= 0.5 + slack.y;
    return isInside ? t : nowhere;
}

Hit traceToPlanes(Photon photon, ivec2 texel) {
    if (!isNumber(photon)) {
        ledgerAdd(kAccountNotANumber, vec3(0.0));
        return emptyHit();
    }
    if (isInBody(photon.media)) {
        ledgerAdd(kAccountMissedByTracer, photon.fluxWatts);
        return emptyHit();
    }
    int nearest = -1;
    float nearestT = 0.0;
    for (int i = 0; i < faceCount; ++i) {
        float t = intersectFace(flatFaces[i], photon.positionVs, photon.directionVs);
        if (t < 0.0 || (nearest >= 0 && t >= nearestT)) continue;
        nearest = i;
        nearestT = t;
    }
    if (isStopped(texel, nearest < 0 ? 3.0e38 : nearestT)) return stoppedHit(photon, texel);
    if (nearest < 0) {
        ledgerAdd(missAccount, photon.fluxWatts);
        return emptyHit();
    }
    vec4 normal = flatFaces[nearest].normal;
    return deliverTo(photon, nearestT, normal.xyz, normal.xyz, uint(normal.w));
}

void threadMain() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    Photon photon = photonAt(texel);
    Hit hit = emptyHit();
    if (photon.fate == kFateInFlight) hit = traceToPlanes(photon, texel);
    storeHit(texel, hit);
}
