// SPDX-License-Identifier: MIT
// Where each workgroup's cells and photons go, and whether there is to be another round. One
// workgroup.
#include "light_cells/next_round.glsl"

const uint kThreads = 256u;
layout(local_size_x = 256) in;

layout(std430) buffer GroupFirsts {
    uvec2 groupFirsts[];
};
shared uvec2 sums[kThreads];

void main() {
    uint groups = (counting.taken + 63u) / 64u;
    uint each = (groups + kThreads - 1u) / kThreads;
    uint first = min(gl_LocalInvocationIndex * each, groups);
    uint end = min(first + each, groups);
    uvec2 sum = uvec2(0u);
    for (uint i = first; i < end; ++i)
        sum += groupFirsts[i];
    sums[gl_LocalInvocationIndex] = sum;
    barrier();
    uvec2 before = uvec2(counting.waiting, counting.photons);
    for (uint i = 0u; i < gl_LocalInvocationIndex; ++i)
        before += sums[i];
    for (uint i = first; i < end; ++i) {
        uvec2 count = groupFirsts[i];
        groupFirsts[i] = before;
        before += count;
    }
    barrier();
    if (gl_LocalInvocationIndex == kThreads - 1u) closeRound(before.x, before.y);
}
