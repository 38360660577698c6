// SPDX-License-Identifier: MIT
// Makes of each workgroup's number of photons the place of its first one in the next list, so that
// the order is kept, and says how long that list is. One workgroup.
#include "include/photons/photons.glsl"

const uint kThreads = 256u;
layout(local_size_x = 256) in;

layout(std430) buffer NextFirsts {
    uint nextFirsts[];
};
layout(std430) writeonly buffer NextPhotons {
    PhotonList nextPhotons;
};
uniform int nextRowLength;
shared uint sums[kThreads];

void main() {
    uint groups = (photons.count + kPhotonGroup - 1u) / kPhotonGroup;
    uint each = (groups + kThreads - 1u) / kThreads;
    uint first = min(gl_LocalInvocationIndex * each, groups);
    uint end = min(first + each, groups);
    uint sum = 0u;
    for (uint i = first; i < end; ++i)
        sum += nextFirsts[i];
    sums[gl_LocalInvocationIndex] = sum;
    barrier();
    uint before = 0u;
    for (uint i = 0u; i < gl_LocalInvocationIndex; ++i)
        before += sums[i];
    for (uint i = first; i < end; ++i) {
        uint count = nextFirsts[i];
        nextFirsts[i] = before;
        before += count;
    }
    if (gl_LocalInvocationIndex == kThreads - 1u)
        nextPhotons = photonListOf(before, uint(nextRowLength));
}
