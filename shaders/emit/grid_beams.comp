// SPDX-License-Identifier: MIT
// The beams of photons of one light's grid, where they have hit their first surface: parallel light
// is as wide as a cell, light from a point spreads; and how that surface turns there. One thread a
// cell.
#include "include/photons/beam.glsl"
#include "include/photons/light_grid.glsl"
#include "include/photons/photons.glsl"

layout(rgba32f) writeonly uniform image2D nextBeamPlace;
layout(rgba32f) writeonly uniform image2D nextBeamTurn;
layout(rgba32f) writeonly uniform image2D hitShape;
uniform sampler2D startSurface;
uniform mat3 lightToEye;  // columns: to the grid's right, up, and against the light

Beam emittedBeam(Photon photon, LightData light, bool isParallel) {
    vec2 size = sizeOfCell();
    mat2x3 across = basisAcross(photon.directionVs);
    mat2x3 step = mat2x3(lightToEye[0] * size.x, lightToEye[1] * size.y);
    if (isParallel) return beamFromPoint(transpose(across) * step, mat2(0.0));
    // A cell of the plane at 1 m, seen from the light: the direction is the place, normalised.
    float cosine = max(-dot(photon.directionVs, lightToEye[2]), 0.0);
    mat2 turn = transpose(across) * (step * cosine);
    return beamFromPoint(turn * length(photon.positionVs - light.positionVs.xyz), turn);
}

void main() {
    ivec2 cell;
    ivec2 texel;
    if (!cellOfThread(cell, texel)) return;
    Photon photon = photonAt(texel);
    LightData light = lights[lightIndex];
    bool isParallel = uint(light.positionVs.w) == kLightDirectional;
    Beam beam = beamFromPoint(mat2(0.0), mat2(0.0));
    vec3 shape = vec3(0.0);
    if (photon.fate == kFateSpecular) {
        beam = emittedBeam(photon, light, isParallel);
        PointOnTriangle point =
            pointOnTriangle(seenThrough(cell), placeOfCell(cell), isParallel);
        // Of what is interpolated over the triangle, as the normals are.
        float size = max(length(point.normal), 1e-12);
        shape = shapeFrom(texelFetch(startSurface, texel, 0).xyz, point.places, point.turns / size);
    }
    imageStore(nextBeamPlace, texel, beamPlaceTexel(beam));
    imageStore(nextBeamTurn, texel, beamTurnTexel(beam));
    imageStore(hitShape, texel, vec4(shape, 0.0));
}
