// SPDX-License-Identifier: MIT
// Appends what transform feedback has captured to the lists. One thread a captured cell, or photon.
#include "light_cells/cell_lists.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer CapturedCells {
    LightCell capturedCells[];
};
layout(std430) readonly buffer CapturedPhotons {
    LightCell capturedPhotons[];
};
layout(std430) readonly buffer CapturedCounts {
    uvec2 captured;
};
layout(std430) writeonly buffer WaitingCells {
    LightCell waitingCells[];
};
layout(std430) writeonly buffer PhotonCells {
    LightCell photonCells[];
};

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint index = group * 64u + gl_LocalInvocationIndex;
    if (index < captured.x) waitingCells[counting.waiting + index] = capturedCells[index];
    if (index < captured.y) photonCells[counting.photons + index] = capturedPhotons[index];
}
