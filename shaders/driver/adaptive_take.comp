// SPDX-License-Identifier: MIT
// Moves the cells that a round takes out of the way of those that it leaves, and lists their
// quarters. One thread a cell.
#include "light_cells/cell_lists.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer WaitingCells {
    LightCell waitingCells[];
};
layout(std430) writeonly buffer TakenCells {
    LightCell takenCells[];
};
layout(std430) writeonly buffer ProbeCells {
    LightCell probeCells[];
};

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint index = group * 64u + gl_LocalInvocationIndex;
    if (index >= counting.taken) return;
    LightCell cell = waitingCells[counting.waiting + index];
    takenCells[index] = cell;
    for (uint quarter = 0u; quarter < 4u; ++quarter)
        probeCells[4u * index + quarter] = quarterOfCell(cell, quarter);
}
