// SPDX-License-Identifier: MIT
// How many photons have arrived, and how many of them are stored. One thread.
#include "light_cells/cell_lists.glsl"
#include "driver/hierarchical.glsl"

layout(local_size_x = 1) in;

layout(std430) readonly buffer StoredList {
    PhotonList storedList;
};
uniform int first;        // node of a level
uniform int squareCount;  // of it

void main() {
    for (int square = 0; square < squareCount; ++square)
        counting.probes += uint(nodes[first + square].flux.w);
    counting.emitted += storedList.count;
}
