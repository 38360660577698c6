// SPDX-License-Identifier: MIT
// By how much a photon's light, which has a size, spreads what comes to the photon's place: the disc
// that its point stands for, as it is seen from there. One thread a photon.
#include "include/photons/beam.glsl"
#include "include/photons/lights.glsl"
#include "include/photons/photon_thread.glsl"

layout(rgba32f) writeonly uniform image2D nextSpreadPlace;
layout(rgba32f) writeonly uniform image2D nextSpreadTurn;

// Of the direction, rad: to the disc's edge along two directions.
mat2 turnFromDisc(Photon photon, LightData light) {
    float radius = light.power.w;
    mat3x2 across = transpose(basisAcross(photon.directionVs));
    uint kind = uint(light.positionVs.w);
    if (kind == kLightDirectional) return mat2(radius);
    if (kind != kLightSurface) return mat2(0.0);
    float distance = length(photon.positionVs - light.positionVs.xyz);
    // As the light's place moves one way, what comes from it turns the other.
    return across * basisAcross(light.directionVs.xyz) * (-radius / max(distance, 1e-20));
}

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    mat2 turn = mat2(0.0);
    if (fateAt(texel) == kFateSpecular)
        turn = turnFromDisc(photonAt(texel), lights[originAt(texel).light]);
    imageStore(nextSpreadPlace, texel, vec4(0.0));
    imageStore(nextSpreadTurn, texel, vec4(turn[0], turn[1]));
}
