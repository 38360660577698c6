// SPDX-License-Identifier: MIT
// The last part of the reduce: the column of first hits becomes hits in the transfer map, or, for a
// photon that hit nothing, an entry in the ledger. One thread a row.
#include "include/thread.glsl"
#include "include/photons/photons.glsl"
#include "include/photons/store_hits.glsl"
#include "include/photons/traced_photon.glsl"
#include "trace/lines_row_extent.glsl"
#include "trace/lines_row_texel.glsl"

uniform sampler2D column;
uniform int firstPhoton;
uniform int rowsWidth;

void main() {
    int row = int(threadNumber());
    uint index = uint(firstPhoton + row);
    if (index >= photons.count || row >= textureSize(column, 0).y) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    Photon photon = photonAt(texel);
    if (photon.fate != kFateInFlight) {
        storeHit(texel, emptyHit());
        return;
    }

    FirstHit first = noHit();
    int stepIndex;
    vec2 found = rowExtents[batch] > 0u ? texelFetch(column, ivec2(0, row), 0).xy : vec2(0.0);
    unpackRowTexel(found, first.hit, stepIndex, first.isExit);
    if (first.hit.layer >= 0) {
        RaySegment segment = clipRay(photon.positionVs, photon.directionVs);
        int steps = stepCount(segment, trace_lines_minimum, rowsWidth);
        first.pixel = texelOfStep(segment, stepIndex, steps);
    }
    storeHit(texel, deliver(photon, first));
}
