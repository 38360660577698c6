// SPDX-License-Identifier: MIT
// Whether the lists hold all fragments of a view, and none is longer than a thread can walk.
#include "framework/transport/types.h"
#include "layered_depth/fragment_lists.glsl"

layout(std430) readonly buffer Statistics {
    LayerStatistics statistics;
};
uniform int layerCount;
uniform uint maxIterations;

bool listsFit() {
    return fragmentCounts[face] <= capacity &&
           statistics.complexity <= maxIterations / uint(layerCount + 2);
}
