// SPDX-License-Identifier: MIT
// Squares of pixels that show one surface: a wide beam puts its light into the whole of them, and in
// the end the pixels share it (several resolutions on the screen: Nichols and Wyman 2009, there of
// indirect light). Exact but for where a beam's border lies within a square.
#include "reconstruct/triangles_patch.glsl"

const int kBlockSide = 4;  // px

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
    return (ivec2(view.sizePixels.xy) + kBlockSide - 1) / kBlockSide;
}

// The blocks on a line of them, first and last, that a patch can cover; none where x > y.
ivec2 blockSpanOf(PatchLines lines, int line) {
    vec2 heights = vec2(kBlockSide * line - lines.base.y) + vec2(0.0, kBlockSide);
    vec2 span = vec2(1e9, -1e9);
    addToSpan(span, lines.first, heights);
    addToSpan(span, lines.second, heights);
    if (span.x > span.y) return ivec2(1, 0);
    ivec2 pixels = ivec2(floor(span)) + lines.base.x;
    return ivec2(max(pixels.x, lines.low.x), min(pixels.y, lines.high.x)) / kBlockSide;
}

int blockAt(ivec2 pixel) {
    return pixel.y / kBlockSide * blocksOfView().x + pixel.x / kBlockSide;
}
