// SPDX-License-Identifier: MIT
// The beams of photons of one light's grid, where they have hit their first surface: parallel light
// is as wide as a texel, light from a point spreads. One thread a photon.
#include "include/lights.glsl"
#include "include/photon_thread.glsl"

layout(rgba32f) writeonly uniform image2D nextBeamPlace;
layout(rgba32f) writeonly uniform image2D nextBeamTurn;
uniform int lightIndex;
uniform vec2 texelSize;   // m, or tangents
uniform mat3 lightToEye;  // columns: to the grid's right, up, and against the light

Beam emittedBeam(Photon photon, LightData light) {
    mat2x3 across = basisAcross(photon.directionVs);
    mat2x3 step = mat2x3(lightToEye[0] * texelSize.x, lightToEye[1] * texelSize.y);
    if (uint(light.positionVs.w) == kLightDirectional) {
        return Beam(transpose(across) * step, mat2(0.0));
    }
    // A texel of the plane at 1 m, seen from the light: the direction is the place, normalised.
    float cosine = max(-dot(photon.directionVs, lightToEye[2]), 0.0);
    mat2 turn = transpose(across) * (step * cosine);
    return Beam(turn * length(photon.positionVs - light.positionVs.xyz), turn);
}

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    PhotonOrigin origin = originAt(texel);
    Photon photon = photonAt(texel);
    bool isHere = photon.fate == kFateSpecular;
    if (isHere && origin.light != uint(lightIndex)) return;
    Beam beam = isHere ? emittedBeam(photon, lights[lightIndex]) : Beam(mat2(0.0), mat2(0.0));
    imageStore(nextBeamPlace, texel, beamPlaceTexel(beam));
    imageStore(nextBeamTurn, texel, beamTurnTexel(beam));
}
