// SPDX-License-Identifier: MIT
// reconstruct.pixel_blocks: what the processor has put into pixels goes to the map. One thread a pixel.
#include "include/maps/flux_sum.glsl"
#include "include/thread.glsl"
#include "include/views/view.glsl"
#include "reconstruct/add_words.glsl"

layout(std430) readonly buffer PixelSums {
    uint pixelSums[];  // W; low and high words of each channel
};

void main() {
    ivec2 size = ivec2(view.sizePixels.xy);
    uint index = threadNumber();
    if (index >= uint(size.x * size.y)) return;
    ivec2 pixel = ivec2(index % uint(size.x), index / uint(size.x));
    for (int channel = 0; channel < 3; ++channel) {
        uint at = 6u * index + 2u * uint(channel);
        addWords(ivec3(pixel, int(kFluxWords) * viewIndex + 2 * channel),
                 uvec2(pixelSums[at], pixelSums[at + 1u]));
    }
}
