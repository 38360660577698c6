// SPDX-License-Identifier: MIT
// The maximum, the sum and the overflow of the fragment counts, of each workgroup and then of all.
// Integer atomics: the same always.
#include "framework/transport/types.h"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D counts;
uniform int layerCount;
uniform ivec2 firstPixel;  // of those that are asked for
layout(std430) buffer Statistics {
    LayerStatistics statistics;
};

shared LayerStatistics ofGroup;

void main() {
    bool isFirst = gl_LocalInvocationIndex == 0u;
    if (isFirst) ofGroup = LayerStatistics(0u, 0u, 0u, 0u);
    barrier();
    ivec2 pixel = firstPixel + ivec2(gl_GlobalInvocationID.xy);
    bool isPixel = all(lessThan(pixel, textureSize(counts, 0)));
    uint count = isPixel ? uint(texelFetch(counts, pixel, 0).x) : 0u;
    if (count > 0u) {
        atomicMax(ofGroup.complexity, count);
        atomicAdd(ofGroup.fragments, count);
    }
    if (count > uint(layerCount)) {
        atomicAdd(ofGroup.skipped, count - uint(layerCount));
        atomicAdd(ofGroup.pixelsSkipped, 1u);
    }
    barrier();
    if (!isFirst || ofGroup.fragments == 0u) return;
    atomicMax(statistics.complexity, ofGroup.complexity);
    atomicAdd(statistics.fragments, ofGroup.fragments);
    if (ofGroup.skipped == 0u) return;
    atomicAdd(statistics.skipped, ofGroup.skipped);
    atomicAdd(statistics.pixelsSkipped, ofGroup.pixelsSkipped);
}
