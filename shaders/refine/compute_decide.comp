// SPDX-License-Identifier: MIT
// Decides on every cell that was taken, and counts what that leaves by workgroups, so that lists keep
// their order. One thread a cell.
#include "light_cells/refine.glsl"

layout(local_size_x = 64) in;

layout(std430) writeonly buffer Decisions {
    uint decisions[];
};
layout(std430) writeonly buffer GroupFirsts {
    uvec2 groupFirsts[];  // cells that wait, and photons
};
shared uint waitingHere;
shared uint photonsHere;

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        waitingHere = 0u;
        photonsHere = 0u;
    }
    barrier();
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint index = group * 64u + gl_LocalInvocationIndex;
    if (index < counting.taken) {
        uint decision = decisionOn(index);
        decisions[index] = decision;
        atomicAdd(waitingHere, waitingOf(decision));
        atomicAdd(photonsHere, photonsOf(decision));
        noteDecision(index, decision);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && group * 64u < counting.taken)
        groupFirsts[group] = uvec2(waitingHere, photonsHere);
}
