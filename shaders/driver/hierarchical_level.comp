// SPDX-License-Identifier: MIT
// All squares of a level of the walk are listed: how many threads look at them. One thread.
#include "light_cells/cell_lists.glsl"
#include "driver/hierarchical_walk.glsl"

layout(local_size_x = 1) in;

uniform int level;

void main() {
    uint count = walkLists[level].count;
    walkLists[level] = photonListOf(count, 1u);
    counting.squares[level] += count;
}
