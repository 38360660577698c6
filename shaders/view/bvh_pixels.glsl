// SPDX-License-Identifier: MIT
// view.bvh: the pixels that look at something specular, and the arguments of an indirect dispatch
// over them.
struct PixelCount {
    uint count;
    uint groupsX;
    uint groupsY;
    uint groupsZ;
};
layout(std430) buffer LookedThrough {
    PixelCount lookedThrough;
    uint listedPixels[];  // x + 65536 y
};

ivec2 listedPixel(uint index) {
    return ivec2(listedPixels[index] & 0xffffu, listedPixels[index] >> 16u);
}
