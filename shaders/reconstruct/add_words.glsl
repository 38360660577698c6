// SPDX-License-Identifier: MIT
// Adds to a channel of the map what one thread has for it, low and high word.
#include "include/maps/flux_sum.glsl"

// No atomic: all others have added what they have.
void addWords(ivec3 word, uvec2 sum) {
    if (sum == uvec2(0u)) return;
    uint before = imageLoad(fluxSums, word).x;
    uint carry;
    uint low = uaddCarry(before, sum.x, carry);
    imageStore(fluxSums, word, uvec4(low));
    uint high = sum.y + carry;
    if (high == 0u) return;
    ivec3 above = word + ivec3(0, 0, 1);
    imageStore(fluxSums, above, uvec4(imageLoad(fluxSums, above).x + high));
}
