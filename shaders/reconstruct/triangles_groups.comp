// SPDX-License-Identifier: MIT
// The workgroups for so many patches: of 64 threads one each, or one each.
#include "framework/transport/types.h"
#include "reconstruct/triangles_patch_list.glsl"

layout(local_size_x = 1) in;

uniform int isWide;  // below 0: there are none yet

void main() {
    if (isWide < 0) {
        patches.count = 0u;
        widePatches.count = 0u;
        return;
    }
    uint groups = isWide == 1 ? widePatches.count : (patches.count + 63u) / 64u;
    uvec3 size = uvec3(min(groups, kMaxGroupsX), (groups + kMaxGroupsX - 1u) / kMaxGroupsX, 1u);
    if (isWide == 1) {
        widePatches.groupsX = size.x;
        widePatches.groupsY = size.y;
        widePatches.groupsZ = size.z;
    } else {
        patches.groupsX = size.x;
        patches.groupsY = size.y;
        patches.groupsZ = size.z;
    }
}
