// SPDX-License-Identifier: MIT
// view.bvh: the pixels that look at something specular, and what is stored of them.
#include "include/thread_list.glsl"
#include "include/views/path_ending.glsl"
#include "include/views/view_sample.glsl"

layout(rgba32f) uniform image2D viewRadiance;
#ifndef BESIDE_MIDDLE
layout(r32f) writeonly uniform image2D viewPathEnding;
#endif
#ifdef EXITS
layout(rgba32f) writeonly uniform image2D viewExitPosition;
layout(rgba32f) writeonly uniform image2D viewExitDirection;
#endif

layout(std430) buffer LookedThrough {
    ThreadList lookedThrough;
    uint listedPixels[];  // x + 65536 y
};

ivec2 listedPixel(uint index) {
    return ivec2(listedPixels[index] & 0xffffu, listedPixels[index] >> 16u);
}

// What the pixel sees by this sample, which adds its share.
void storeRadiance(ivec2 pixel, vec4 radiance) {
    weigh(radiance);
#ifdef BESIDE_MIDDLE
    radiance += imageLoad(viewRadiance, pixel);
#endif
    imageStore(viewRadiance, pixel, radiance);
}

// How the middle's ray ended, and, with EXITS, where it left for good, with how many surfaces it
// met; its direction, with how it ended (kPath…), or 0.
void storeExit(ivec2 pixel, vec4 position, vec4 direction) {
#ifndef BESIDE_MIDDLE
    imageStore(viewPathEnding, pixel, vec4(pathEndingOf(direction)));
#endif
#ifdef EXITS
    imageStore(viewExitPosition, pixel, position);
    imageStore(viewExitDirection, pixel, direction);
#endif
}
