// SPDX-License-Identifier: MIT
// reconstruct.pixel_blocks: what squares of pixels have of wide patches goes to their pixels, by the
// area that each sees: the same irradiance, and together the same flux to the last unit. One thread a
// square.
#include "include/maps/flux_sum.glsl"
#include "include/thread.glsl"
#include "include/views/seen_receiver.glsl"
#include "reconstruct/add_words.glsl"
#include "reconstruct/triangles_pixel_blocks.glsl"

// floor(sum part / 65536), low and high word; `part` from 0 to 65536.
uvec2 partOfSum(uvec2 sum, uint part) {
    uint carry;
    uint lowHigh;
    uint lowLow;
    umulExtended(sum.x, part, lowHigh, lowLow);
    uint highHigh;
    uint highLow;
    umulExtended(sum.y, part, highHigh, highLow);
    uint middle = uaddCarry(lowHigh, highLow, carry);
    return uvec2(lowLow >> 16u | middle << 16u, middle >> 16u | (highHigh + carry) << 16u);
}

void main() {
    ivec2 blocks = blocksOfView();
    uint index = threadNumber();
    if (index >= uint(blocks.x * blocks.y)) return;
    uint sums[6] = pixelBlocks[index].sums;
    if ((sums[0] | sums[1] | sums[2] | sums[3] | sums[4] | sums[5]) == 0u) return;
    ivec2 corner = kPixelBlockSide * ivec2(index % uint(blocks.x), index / uint(blocks.x));
    const int kPixels = kPixelBlockSide * kPixelBlockSide;
    float perArea = 65536.0 / (float(kPixels) * pixelBlocks[index].receiver.y);
    float area = 0.0;
    uvec2 given[3] = uvec2[3](uvec2(0u), uvec2(0u), uvec2(0u));
    for (int i = 0; i < kPixels; ++i) {
        ivec2 pixel = corner + ivec2(i % kPixelBlockSide, i / kPixelBlockSide);
        area += receiverAt(pixel).y;
        uint end = i == kPixels - 1 ? 65536u : min(uint(area * perArea + 0.5), 65536u);
        for (int channel = 0; channel < 3; ++channel) {
            uvec2 upToHere = partOfSum(uvec2(sums[2 * channel], sums[2 * channel + 1]), end);
            uint borrow;
            uint low = usubBorrow(upToHere.x, given[channel].x, borrow);
            addWords(ivec3(pixel, int(kFluxWords) * viewIndex + 2 * channel),
                     uvec2(low, upToHere.y - given[channel].y - borrow));
            given[channel] = upToHere;
        }
    }
}
