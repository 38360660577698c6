// SPDX-License-Identifier: MIT
// around.order: a slot for every kind, another than those of all that it is seen with, as long as
// there are any. One work group, a thread for each word of a kind's conflicts; kinds have theirs in
// turn.
#include "around/cubes_order.glsl"

const uint kWords = kKinds / 32u;
layout(local_size_x = kWords) in;

layout(std430) readonly buffer KindConflicts {
    uint conflicts[];
};
layout(std430) writeonly buffer KindSlots {
    uint slots[];
};

shared uint slotsOfKinds[kKinds];
shared uint takenByWords[kWords];

void main() {
    uint word = gl_LocalInvocationIndex;
    for (uint kind = 0u; kind < kKinds; ++kind) {
        // Those that have had their slots.
        uint others = word <= kind / 32u ? conflicts[kind * kWords + word] : 0u;
        if (word == kind / 32u) others &= (1u << (kind % 32u)) - 1u;
        uint taken = 0u;
        while (others != 0u) {
            uint other = uint(findLSB(others));
            others &= others - 1u;
            taken |= 1u << slotsOfKinds[word * 32u + other];
        }
        takenByWords[word] = taken;
        barrier();
        if (word == 0u) {
            for (uint i = 1u; i < kWords; ++i) taken |= takenByWords[i];
            uint slot = uint(findLSB(~taken));
            slotsOfKinds[kind] = slot < uint(layerCount) ? slot : kNoSlot;
        }
        barrier();
    }
    for (uint kind = word; kind < kKinds; kind += kWords) slots[kind] = slotsOfKinds[kind];
}
