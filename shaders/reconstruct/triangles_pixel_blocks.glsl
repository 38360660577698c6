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

int blockOnLine(PatchLines lines, int line, int place, out ivec2 corner) {
    ivec2 block = pixelOnLine(lines, line, place);
    corner = kBlockSide * block;
    return block.y * blocksOfView().x + block.x;
}

// The shares of a patch that a block with one surface has, as patchAt() has those of a pixel.
PlanePixel patchAtBlock(PatchOnScreen onto, ivec2 corner, vec4 receiver) {
    PlanePixel made = PlanePixel(0.0, 0.0, 0.0, 0.0);
    const float side = float(kBlockSide);
    float first = partOf(onto.first, vec2(corner - onto.base), side);
    float second = partOf(onto.second, vec2(corner - onto.base), side);
    if (first + second <= 0.0) return made;
    bool isFirst = first >= second;
    addSeen(made, vec2(corner) + 0.5 * side, receiver.xy, unpackUnitVector(receiver.zw),
            isFirst ? onto.first.plane : onto.second.plane,
            isFirst ? onto.first.middle : onto.second.middle,
            isFirst ? onto.first.isShaded : onto.second.isShaded, onto.side, onto.tolerance, false,
            (first + second) * side * side, receiver.y);
    return made;
}
