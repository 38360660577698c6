// SPDX-License-Identifier: MIT
// Squares of pixels that show one surface: a wide beam puts its light into the whole of them, and in
// the end the pixels share it (several resolutions on the screen: Nichols and Wyman 2009, there of
// indirect light). Exact but for where a beam's border lies within a square.
#include "framework/transport/patches.h"
#include "include/views/view.glsl"

struct PixelBlock {
    // What it shows: view depth at its middle, m; a pixel's mean area, m²; the normal, packed. Depth
    // and area 0: no receiver; the area negative: more than one surface.
    vec4 receiver;
    uint sums[6];  // W; low and high words of each channel as flux_sum.glsl has them
};
layout(std430) buffer PixelBlocks {
    PixelBlock pixelBlocks[];
};

ivec2 blocksOfView() {
    return (ivec2(view.sizePixels.xy) + kPixelBlockSide - 1) / kPixelBlockSide;
}

int blockAt(ivec2 pixel) {
    return pixel.y / kPixelBlockSide * blocksOfView().x + pixel.x / kPixelBlockSide;
}
