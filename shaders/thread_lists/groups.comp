// SPDX-License-Identifier: MIT
// Empties a list of work, or says how many workgroups it takes, a thread each.
#include "include/thread_list.glsl"

layout(local_size_x = 1) in;

layout(std430) buffer ListedThreads {
    ThreadList threads;
};
uniform int isListed;  // 0: there are none yet

void main() {
    if (isListed == 0) threads.count = 0u;
    setGroups(threads, threads.count);
}
