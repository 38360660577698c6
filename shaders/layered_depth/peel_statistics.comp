// SPDX-License-Identifier: MIT
// The maximum, the sum and the overflow of the fragment counts. Integer atomics: the same always.
#include "framework/transport/types.h"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D counts;
uniform int layerCount;
uniform ivec2 firstPixel;  // of those that are asked for
layout(std430) buffer Statistics {
    LayerStatistics statistics;
};

void main() {
    ivec2 pixel = firstPixel + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, textureSize(counts, 0)))) return;
    uint count = uint(texelFetch(counts, pixel, 0).x);
    if (count == 0u) return;
    atomicMax(statistics.complexity, count);
    atomicAdd(statistics.fragments, count);
    if (count > uint(layerCount)) {
        atomicAdd(statistics.skipped, count - uint(layerCount));
        atomicAdd(statistics.pixelsSkipped, 1u);
    }
}
