// SPDX-License-Identifier: MIT
// The beams of photons of emit.deferred, as wide as their cells, and how the surface that they hit
// turns there. One thread a photon of one light.
#include "include/photons/beam.glsl"
#include "include/photons/photon_thread.glsl"
#include "emit/deferred_cell.glsl"

layout(rgba32f) writeonly uniform image2D nextBeamPlace;
layout(rgba32f) writeonly uniform image2D nextBeamTurn;
layout(rgba32f) writeonly uniform image2D hitShape;
uniform sampler2D startSurface;

Beam emittedBeam(Photon photon, LightData light, vec2 ndcSize) {
    vec2 size = ndcSize * extentOfCells();
    mat3 toEye = transpose(mat3(view.fromEye));
    mat2x3 across = basisAcross(photon.directionVs);
    mat2x3 step = mat2x3(toEye[0] * size.x, toEye[1] * size.y);
#ifdef ORTHOGRAPHIC_VIEW
    return beamFromPoint(transpose(across) * step, mat2(0.0));
#else
    // A cell of the plane at 1 m, seen from the light: the direction is the place, normalised.
    float cosine = max(-dot(photon.directionVs, toEye[2]), 0.0);
    mat2 turn = transpose(across) * (step * cosine);
    return beamFromPoint(turn * length(photon.positionVs - light.positionVs.xyz), turn);
#endif
}

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
#ifndef CELL_LIST
    uint perLight = uint(gridSize.x * rowsHere);
    if (int(index / perLight) + firstLight != lightIndex) return;
    CellOfLight cell = cellOfPhoton(index % perLight);
#else
    CellOfLight cell = cellOfPhoton(index);
    if (!cell.isOwn) return;
#endif
    Photon photon = photonAt(texel);
    Beam beam = beamFromPoint(mat2(0.0), mat2(0.0));
    vec3 shape = vec3(0.0);
    if (photon.fate == kFateSpecular) {
        beam = emittedBeam(photon, lights[lightIndex], cell.size);
        DeferredPoint at =
            pointOfCell(cell, emit_deferred_lookup == emit_deferred_lookup_triangle);
        shape = shapeFrom(texelFetch(startSurface, texel, 0).xyz, at.places, at.turns);
    }
    imageStore(nextBeamPlace, texel, beamPlaceTexel(beam));
    imageStore(nextBeamTurn, texel, beamTurnTexel(beam));
    imageStore(hitShape, texel, vec4(shape, 0.0));
}
