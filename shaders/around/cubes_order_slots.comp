// SPDX-License-Identifier: MIT
// around.order: a slot for every kind, another than those of all that it is seen with, as long as
// there are any. One thread.
#include "around/cubes_order.glsl"

layout(local_size_x = 1) in;

layout(std430) readonly buffer KindConflicts {
    uint conflicts[];
};
layout(std430) buffer KindSlots {
    uint slots[];
};

void main() {
    for (uint kind = 0u; kind < kKinds; ++kind) {
        uint taken = 0u;
        uint first = kind * (kKinds / 32u);
        for (uint word = 0u; word <= kind / 32u; ++word) {
            uint others = conflicts[first + word];
            // Those that have had their slots.
            if (word == kind / 32u) others &= (1u << (kind % 32u)) - 1u;
            while (others != 0u) {
                uint other = uint(findLSB(others));
                others &= others - 1u;
                taken |= 1u << slots[word * 32u + other];
            }
        }
        uint slot = uint(findLSB(~taken));
        slots[kind] = slot < uint(layerCount) ? slot : kNoSlot;
    }
}
