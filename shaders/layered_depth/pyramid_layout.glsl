// SPDX-License-Identifier: MIT
// The layers' pyramid: where its levels lie in its texture, level 1 at the left, the others right
// of it, one above the other. A texel of level k covers a square of 4^k pixels; x: nearness in its
// middle (include/views/view.glsl; 0: the layer is empty there), yz: by how much it grows a pixel, w: how
// far from that plane a ray may be and still hit the layer.
const int kPyramidLevels = 3;

ivec2 pyramidSize(ivec2 pixels, int level) {
    return (pixels + (1 << (2 * level)) - 1) >> (2 * level);
}

ivec2 pyramidOffset(ivec2 pixels, int level) {
    if (level == 1) return ivec2(0);
    return ivec2(pyramidSize(pixels, 1).x, level == 2 ? 0 : pyramidSize(pixels, 2).y);
}

// The most that nearness differs within a margin around a depth.
float nearnessMargin(float depth, float margin) {
    if (depth <= 0.0) return 0.0;
#ifdef ORTHOGRAPHIC_VIEW
    return margin;
#endif
    return margin < 0.999 * depth ? margin / (depth * (depth - margin)) : 1e30;
}
