// SPDX-License-Identifier: MIT
// The last part of the reduce: the column of first hits becomes hits in the transfer map, or, for a
// photon that hit nothing, an entry in the ledger. One thread a row.
#include "include/photons/ledger_of_group.glsl"
#include "include/thread.glsl"
#include "include/photons/photons.glsl"
#include "include/photons/store_hits.glsl"
#include "tracing/tile_search.glsl"
#include "trace/lines_row_extent.glsl"
#include "trace/lines_row_texel.glsl"

uniform sampler2D column;
uniform int firstPhoton;
uniform int maxSteps;

void threadMain() {
    int row = int(threadNumber());
    uint index = uint(firstPhoton + row);
    if (index >= photons.count || row >= textureSize(column, 0).y) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    Photon photon = photonAt(texel);
    if (photon.fate != kFateInFlight) {
        storeOrder(texel, photon, noHit(), emptyHit(), 0u);
        storeHit(texel, emptyHit());
        return;
    }

    FirstHit first = noHit();
    int stepIndex;
    vec2 found = rowExtents[batch] > 0u ? texelFetch(column, ivec2(0, row), 0).xy : vec2(0.0);
    unpackRowTexel(found, first.hit, stepIndex, first.isExit);
    RaySegment segment = clipRay(photon.positionVs, photon.directionVs);
    if (segment.visible) {
        int steps = stepCount(segment, trace_lines_minimum, maxSteps);
        StepRange asked = stepsToAsk(segment, steps);
        countSteps(uint(max(asked.end - asked.first, 0)));
        if (first.hit.layer >= 0) first.pixel = texelOfStep(segment, stepIndex, steps);
    }
    first.step = stepIndex;
    Hit hit = deliver(photon, first);
    // All steps of a row are asked, and the nearest hit counts.
    storeOrder(texel, photon, first, hit, floatBitsToUint(first.hit.t));
    storeHit(texel, hit);
}
