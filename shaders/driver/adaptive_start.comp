// SPDX-License-Identifier: MIT
// The cells that an adaptive traversal begins with, all of every light's, and what is counted from
// there on. One thread a cell.
#include "include/thread.glsl"
#include "light_cells/cell_lists.glsl"

layout(std430) writeonly buffer WaitingCells {
    LightCell waitingCells[];
};
uniform uint side;
uniform uint level;
uniform uint cellCount;

void startCounting() {
    counting.moreCells = 1u;
    counting.moreBatches = 0u;
    counting.waiting = cellCount;
    counting.taken = 0u;
    counting.photons = 0u;
    counting.probes = 0u;
    counting.emitted = 0u;
    counting.merged = 0u;
    counting.discarded = 0u;
    counting.deepest = 0u;
    counting.rounds = 0u;
    counting.batches = 0u;
    for (uint i = 0u; i < kSquareLevels; ++i)
        counting.squares[i] = 0u;
}

void main() {
    uint index = threadNumber();
    if (index == 0u) startCounting();
    if (index >= cellCount) return;
    uint perLight = side * side;
    uint at = index % perLight;
    waitingCells[index] = LightCell(at % side, at / side, level, (index / perLight) << 8u);
}
