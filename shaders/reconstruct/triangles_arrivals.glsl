// SPDX-License-Identifier: MIT
// The photons of the list that have arrived, which are the fewer of it after most interactions.
#include "include/thread.glsl"
#include "include/thread_list.glsl"

layout(std430) buffer Arrivals {
    ThreadList arrivals;
    uint arrivedPhotons[];  // indices
};

// False for the last workgroup's threads that have none.
bool arrivalOfThread(out uint index) {
    uint number = threadNumber();
    bool isOne = number < arrivals.count;
    index = arrivedPhotons[isOne ? number : 0u];
    return isOne;
}
