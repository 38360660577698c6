// SPDX-License-Identifier: MIT
// Takes as many squares as there is room for photons of, in a round. COUNT: how many, one thread;
// else a thread a square.
#include "include/thread.glsl"
#include "light_cells/cell_lists.glsl"

layout(std430) readonly buffer RefinedSquares {
    LightCell refinedSquares[];
};
layout(std430) writeonly buffer TakenSquares {
    LightCell takenSquares[];
};
layout(std430) writeonly buffer TakenList {
    PhotonList takenList;
};
uniform uint maxSquares;
uniform uint photonsOfSquare;
uniform uint rowLength;

void main() {
    uint index = threadNumber();
#ifdef COUNT
    if (index > 0u) return;
    uint taken = min(counting.waiting - counting.photons, maxSquares);
    takenList = photonListOf(taken * photonsOfSquare, rowLength);
    counting.taken = taken;
    counting.photons += taken;
    counting.moreCells = counting.waiting - counting.photons;
    counting.rounds += 1u;
#else
    if (index >= maxSquares) return;
    uint first = counting.photons - counting.taken;
    takenSquares[index] =
        index < counting.taken ? refinedSquares[first + index] : LightCell(0u, 0u, 0u, 0u);
#endif
}
