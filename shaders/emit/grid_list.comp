// SPDX-License-Identifier: MIT
// emit.grid: the cells through whose middles the light sees something specular first, which alone
// have a photon; of the others no more is stored than that they have none. One thread a cell.
#include "include/photons/light_grid.glsl"
#include "include/surfaces/surface_data.glsl"
#include "include/thread_list.glsl"

layout(std430) buffer CellsToEmit {
    ThreadList cellsToEmit;
    uint cellPlaces[];  // column + 65536 row, of those here
};

layout(rgba32f) writeonly uniform image2D nextDirection;
layout(rgba32f) writeonly uniform image2D hitFlux;

void main() {
    ivec2 cell;
    ivec2 texel;
    if (!cellOfThread(cell, texel)) return;
    uint object = seenThrough(cell).x;
    if (object == 0u || isReceiver(materialKind(instances[object - 1u].material.x))) {
        // kFateNone, and so for whoever asks for the photon or for its hit.
        imageStore(nextDirection, texel, vec4(0.0));
        imageStore(hitFlux, texel, vec4(0.0));
        return;
    }
    ivec2 here = cell - ivec2(0, firstRow);
    cellPlaces[atomicAdd(cellsToEmit.count, 1u)] = uint(here.x) | uint(here.y) << 16u;
}
