// SPDX-License-Identifier: MIT
// view.bvh: the workgroups for so many listed pixels, 64 of them each.
#include "framework/transport/types.h"
#include "view/bvh_pixels.glsl"

layout(local_size_x = 1) in;

uniform int isListed;  // 0: there are none yet

void main() {
    if (isListed == 0) {
        lookedThrough.count = 0u;
        return;
    }
    uint groups = (lookedThrough.count + 63u) / 64u;
    lookedThrough.groupsX = min(groups, kMaxGroupsX);
    lookedThrough.groupsY = (groups + kMaxGroupsX - 1u) / kMaxGroupsX;
    lookedThrough.groupsZ = 1u;
}
