// SPDX-License-Identifier: MIT
// view.bvh: the pixels that look at something specular.
#include "include/thread_list.glsl"

layout(std430) buffer LookedThrough {
    ThreadList lookedThrough;
    uint listedPixels[];  // x + 65536 y
};

ivec2 listedPixel(uint index) {
    return ivec2(listedPixels[index] & 0xffffu, listedPixels[index] >> 16u);
}
