// SPDX-License-Identifier: MIT
// around.order: each texel's layers into their slots; those whose kind has none, or whose slot is
// taken, into what is free. One thread a texel.
#include "around/cubes_order.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) readonly buffer KindSlots {
    uint slots[];
};
layout(r32ui) writeonly uniform uimage2DArray layerOrder;
uniform int isSmooth;

void main() {
    ivec2 texel;
    if (!texelOfThread(gl_GlobalInvocationID.xy, texel)) return;
    uint kinds[kMaxLayers];
    int count = kindsAt(texel, kinds);
    uint order = 0xffffffffu;
    uint taken = 0u;
    uint placed = 0u;
    for (int layer = 0; layer < count; ++layer) {
        uint slot = isSmooth == 1 ? slots[kinds[layer]] : uint(layer);
        if (slot >= uint(layerCount) || (taken & (1u << slot)) != 0u) continue;
        taken |= 1u << slot;
        placed |= 1u << layer;
        order = bitfieldInsert(order, uint(layer), int(4u * slot), 4);
    }
    for (int layer = 0; layer < count; ++layer) {
        if ((placed & (1u << layer)) != 0u) continue;
        int slot = findLSB(~taken);
        taken |= 1u << slot;
        order = bitfieldInsert(order, uint(layer), 4 * slot, 4);
    }
    imageStore(layerOrder, ivec3(texel, viewIndex), uvec4(order));
}
