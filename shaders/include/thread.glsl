// SPDX-License-Identifier: MIT
// A compute thread a number: Command::dispatchOver(count, 64). Where there are more workgroups than
// go along x, they go on along y.
layout(local_size_x = 64) in;

uint workgroupNumber() {
    return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

// Not below the count for the last workgroups' threads.
uint threadNumber() {
    return workgroupNumber() * 64u + gl_LocalInvocationIndex;
}
