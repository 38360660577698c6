// SPDX-License-Identifier: MIT
// Where the levels of the layers' depth pyramid lie in its texture: level 1 at the left, the others
// right of it, one above the other. A texel of level k covers a square of 4^k pixels.
const int kPyramidLevels = 3;

ivec2 pyramidSize(ivec2 pixels, int level) {
    int side = 1 << (2 * level);
    return (pixels + side - 1) / side;
}

ivec2 pyramidOffset(ivec2 pixels, int level) {
    ivec2 offset = ivec2(0);
    if (level > 1) offset.x = pyramidSize(pixels, 1).x;
    for (int below = 2; below < level; ++below)
        offset.y += pyramidSize(pixels, below).y;
    return offset;
}
