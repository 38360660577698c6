// SPDX-License-Identifier: MIT
// One level of the layers' pyramid (pyramid_layout.glsl): for each square and layer a plane in
// nearness, which is linear on the screen where a surface is flat, and how far what a ray may hit
// there lies from it. One thread a square.
#include "framework/transport/octahedral.h"
#include "include/views/view.glsl"
#include "layered_depth/pyramid_layout.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) uniform image2DArray pyramid;
// An image: a software rasteriser looks up no mip levels for one.
layout(rgba32f) readonly uniform image2DArray layerDepths;
uniform int layerCount;
uniform int level;
uniform ivec2 firstSquare;  // of those that are asked for
#ifdef MANY_VIEWS
uniform int face;
#endif

void main() {
    ivec2 pixels = imageSize(layerDepths).xy;
    ivec2 square = firstSquare + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(square, pyramidSize(pixels, level)))) return;
    ivec2 to = pyramidOffset(pixels, level) + square;
    ivec2 from = level == 1 ? ivec2(0) : pyramidOffset(pixels, level - 1);
    ivec2 sizeBelow = level == 1 ? pixels : pyramidSize(pixels, level - 1);
    ivec2 count = min(sizeBelow - 4 * square, 4);
    float side = float(1 << (2 * (level - 1)));  // of a part, px
#ifdef MANY_VIEWS
    viewIndex = face;
#endif
    int first = viewIndex * layerCount;
    for (int layer = first; layer < first + layerCount; ++layer) {
        // Parts of the square: pixels, or squares of the level below.
        vec4 parts[16];
        vec2 slope = vec2(0.0);
        bool isWhole = count == ivec2(4);
        bool isEmpty = true;
        for (int i = 0; i < 16; ++i) {
            ivec2 at = ivec2(i & 3, i >> 2);
            vec4 part = vec4(0.0);
            if (all(lessThan(at, count))) {
                if (level == 1) {
                    ivec2 pixel = 4 * square + at;
                    vec4 texel = imageLoad(layerDepths, ivec3(pixel, layer));
                    float depth = texel.x;
                    float margin = depthMargin(viewRay(vec2(pixel) + 0.5), depth,
                                               unpackUnitVector(texel.yz));
                    part = vec4(depth > 0.0 ? nearnessOf(depth) : 0.0, 0.0, 0.0,
                                nearnessMargin(depth, margin));
                } else {
                    part = imageLoad(pyramid, ivec3(from + 4 * square + at, layer));
                }
            }
            parts[i] = part;
            isWhole = isWhole && part.x > 0.0;
            isEmpty = isEmpty && part.x <= 0.0;
            slope += (vec2(at) - 1.5) * part.x;
        }
        if (isEmpty) return;  // all deeper ones are; the texture has been cleared
        // Least squares over the middles of all parts; without some of them level.
        slope = isWhole ? slope / (20.0 * side) : vec2(0.0);
        vec2 bounds = vec2(3e38, -3e38);
        for (int i = 0; i < 16; ++i) {
            vec4 part = parts[i];
            if (part.x <= 0.0) continue;
            vec2 middle = (vec2(i & 3, i >> 2) - 1.5) * side;
            float intercept = part.x - dot(slope, middle);
            // Its own plane turns from this one towards its corners.
            vec2 turn = abs(part.yz - slope) * 0.5 * side;
            float reach = part.w + (level == 1 ? 0.0 : turn.x + turn.y);
            bounds = vec2(min(bounds.x, intercept - reach), max(bounds.y, intercept + reach));
        }
        float reach = 0.5 * (bounds.y - bounds.x);
        // The ray's pixel position is up to half a pixel from the middle that was measured.
        if (level == 1) reach += 0.5 * (abs(slope.x) + abs(slope.y));
        float middle = 0.5 * (bounds.x + bounds.y);
        imageStore(pyramid, ivec3(to, layer),
                   vec4(max(middle, 1e-30), slope, reach * (1.0 + 1e-6) + nearnessRounding(middle)));
    }
}
