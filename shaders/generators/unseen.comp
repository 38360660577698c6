// SPDX-License-Identifier: MIT
// Ends photons at specular objects whose light comes to nothing that the eye sees
// (techniques/generators/culling.h): they are not traced on, and their flux is off_screen. Boxes of
// objects that are left out and of others do not overlap, so that the place tells which it is. A
// thread a photon of the list.
#include "include/photons/ledger_of_group.glsl"
#include "include/photons/hits.glsl"
#include "include/photons/photon_thread.glsl"

struct UnseenBox {
    vec4 center;
    vec4 halfExtent;
};
layout(std430) readonly buffer UnseenBoxes {
    UnseenBox boxes[];
};
layout(rgba32f) writeonly uniform image2D keptFlux;
uniform int boxCount;
uniform mat3 eyeToWorld;

bool isAtUnseen(vec3 positionVs) {
    vec3 place = eyeToWorld * positionVs;
    for (int i = 0; i < boxCount; ++i) {
        vec3 halfExtent = boxes[i].halfExtent.xyz;
        // A place on the surface may be rounded to the outside.
        float slack = 1e-5 * (length(halfExtent) + length(positionVs));
        if (all(lessThanEqual(abs(place - boxes[i].center.xyz), halfExtent + slack))) return true;
    }
    return false;
}

void threadMain() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    vec4 flux = texelFetch(hitFlux, texel, 0);
    if (uint(flux.w) == kFateSpecular && isAtUnseen(hitAt(texel).positionVs)) {
        if (originAt(texel).path == kEmittedPath) ledgerAdd(kAccountEmitted, flux.rgb);
        ledgerAdd(kAccountOffScreen, flux.rgb);
        flux = vec4(vec3(0.0), float(kFateEnded));
    }
    imageStore(keptFlux, texel, flux);
}
