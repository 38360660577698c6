// SPDX-License-Identifier: MIT
// Decides on a cell and sends what comes of it to two streams that transform feedback captures: cells
// that wait, and photons (WN09, section 4).
#include "light_cells/refine.glsl"

layout(points) in;
layout(points, max_vertices = 8) out;

flat in uint cellIndex[];

layout(stream = 0, xfb_buffer = 0, xfb_offset = 0, xfb_stride = 16) flat out uvec4 waitingCell;
layout(stream = 1, xfb_buffer = 1, xfb_offset = 0, xfb_stride = 16) flat out uvec4 photonCell;

uvec4 wordsOf(LightCell cell) {
    return uvec4(cell.x, cell.y, cell.level, cell.lightAndQuarters);
}

void main() {
    uint index = cellIndex[0];
    if (index >= counting.taken) return;
    uint decision = decisionOn(index);
    LightCell cell = takenCells[index];
    for (uint i = 0u; i < 4u; ++i) {
        uvec4 quarter = wordsOf(quarterOfCell(cell, i));
        if ((decision & (1u << i)) != 0u) {
            waitingCell = quarter;
            EmitStreamVertex(0);
            EndStreamPrimitive(0);
        }
        if ((decision & (16u << i)) != 0u) {
            photonCell = quarter;
            EmitStreamVertex(1);
            EndStreamPrimitive(1);
        }
    }
    if ((decision >> 8u) != 0u) {
        cell.lightAndQuarters = (cell.lightAndQuarters & ~15u) | (decision >> 8u);
        photonCell = wordsOf(cell);
        EmitStreamVertex(1);
        EndStreamPrimitive(1);
    }
    noteDecision(index, decision);
}
