// SPDX-License-Identifier: MIT
// The last part of the reduce: the column of first hits becomes hits in the transfer map, or, for a
// photon that met nothing, an entry in the ledger. One thread a row.
#include "common/traced_photon.glsl"
#include "screen_space_photons/row_extent.glsl"
#include "screen_space_photons/row_texel.glsl"

layout(local_size_x = 64) in;

layout(rgba32f) uniform image2D hitPosition;
layout(rgba32f) uniform image2D hitSurface;
layout(rgba32f) uniform image2D hitFlux;
uniform sampler2D column;
uniform int firstPhoton;
uniform int photonCount;
uniform int rowsWidth;

void main() {
    int row = int(gl_GlobalInvocationID.x);
    int index = firstPhoton + row;
    if (index >= photonCount || row >= textureSize(column, 0).y) return;
    ivec2 mapSize = textureSize(photonPosition, 0);
    ivec2 texel = ivec2(index % mapSize.x, index / mapSize.x);
    Photon photon = photonAt(texel);
    if (photon.fate != kFateInFlight) return;  // its hit, if any, stands

    FirstHit first = noHit();
    int stepIndex;
    vec2 found = rowExtents[batch] > 0u ? texelFetch(column, ivec2(0, row), 0).xy : vec2(0.0);
    unpackRowTexel(found, first.hit, stepIndex, first.isExit);
    if (first.hit.layer >= 0) {
        RaySegment segment = clipRay(photon.positionVs, photon.directionVs);
        int steps = stepCount(segment, trace_lines_minimum, rowsWidth);
        first.pixel = texelOfStep(segment, stepIndex, steps);
    }
    Hit hit = deliver(photon, first);
    imageStore(hitPosition, texel, hitPositionTexel(hit));
    imageStore(hitSurface, texel, hitSurfaceTexel(hit));
    imageStore(hitFlux, texel, hitFluxTexel(hit));
}
