// SPDX-License-Identifier: MIT
// Counts what has been appended, and whether there is to be another round. One thread.
#include "light_cells/next_round.glsl"

layout(local_size_x = 1) in;

layout(std430) readonly buffer CapturedCounts {
    uvec2 captured;
};

void main() { closeRound(counting.waiting + captured.x, counting.photons + captured.y); }
