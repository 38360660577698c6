// SPDX-License-Identifier: MIT
// Whether the lists hold all fragments of a view, and none is longer than a thread can walk.
#include "framework/transport/types.h"
#include "screen_space_photons/lists.glsl"

layout(std430) readonly buffer Statistics {
    LayerStatistics statistics;
};
uniform int layerCount;
uniform uint mostTurns;

bool listsFit() {
    return fragmentCounts[face] <= room &&
           statistics.complexity <= mostTurns / uint(layerCount + 2);
}
