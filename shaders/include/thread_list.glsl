// SPDX-License-Identifier: MIT
// How many threads a list of work wants that a shader makes on the device
// (techniques/thread_lists/thread_list.h), and the arguments of an indirect dispatch of 64 a group.
#include "framework/transport/types.h"

struct ThreadList {
    uint count;
    uint groupsX;
    uint groupsY;
    uint groupsZ;
};

void setGroups(inout ThreadList list, uint threads) {
    uint groups = (threads + 63u) / 64u;
    list.groupsX = min(groups, kMaxGroupsX);
    list.groupsY = (groups + kMaxGroupsX - 1u) / kMaxGroupsX;
    list.groupsZ = 1u;
}
