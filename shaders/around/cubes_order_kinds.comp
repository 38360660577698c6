// SPDX-License-Identifier: MIT
// around.order: which kinds of surfaces are ever seen behind one another. One thread a texel.
#include "around/cubes_order.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) buffer KindConflicts {
    uint conflicts[];  // 8 words a kind
};

void main() {
    ivec2 texel;
    if (!texelOfThread(gl_GlobalInvocationID.xy, texel)) return;
    uint kinds[kMaxLayers];
    int count = kindsAt(texel, kinds);
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < count; ++j) {
            uint word = kinds[i] * (kKinds / 32u) + kinds[j] / 32u;
            uint bit = 1u << (kinds[j] % 32u);
            if ((conflicts[word] & bit) == 0u) atomicOr(conflicts[word], bit);
        }
    }
}
