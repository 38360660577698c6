// SPDX-License-Identifier: MIT
// Puts quarters on the list of cells that wait, and photons on the list of those. One thread a cell.
#include "light_cells/cell_lists.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer TakenCells {
    LightCell takenCells[];
};
layout(std430) readonly buffer Decisions {
    uint decisions[];
};
layout(std430) readonly buffer GroupFirsts {
    uvec2 groupFirsts[];
};
layout(std430) writeonly buffer WaitingCells {
    LightCell waitingCells[];
};
layout(std430) writeonly buffer PhotonCells {
    LightCell photonCells[];
};
shared uint decided[64];

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint local = gl_LocalInvocationIndex;
    uint index = group * 64u + local;
    uint decision = index < counting.taken ? decisions[index] : 0u;
    decided[local] = decision;
    barrier();
    if (decision == 0u) return;
    uvec2 at = groupFirsts[group];
    for (uint i = 0u; i < local; ++i) {
        uint other = decided[i];
        at += uvec2(bitCount(other & 15u),
                    bitCount(other >> 4u & 15u) + ((other >> 8u) != 0u ? 1 : 0));
    }
    LightCell cell = takenCells[index];
    for (uint i = 0u; i < 4u; ++i) {
        if ((decision & (1u << i)) != 0u) waitingCells[at.x++] = quarterOfCell(cell, i);
        if ((decision & (16u << i)) != 0u) photonCells[at.y++] = quarterOfCell(cell, i);
    }
    if ((decision >> 8u) != 0u) {
        cell.lightAndQuarters = (cell.lightAndQuarters & ~15u) | (decision >> 8u);
        photonCells[at.y] = cell;
    }
}
