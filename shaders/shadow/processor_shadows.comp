// SPDX-License-Identifier: MIT
// shadow.bvh, where the processor traces: stores what it has found. One thread a pixel.
#include "include/views/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform usamplerBuffer litPixels;  // a bit a pixel, rows of whole words
uniform int wordsOfRow;
layout(r32f) writeonly uniform image2DArray visibility;
uniform int lightIndex;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(view.sizePixels.xy)))) return;
    uint word = texelFetch(litPixels, pixel.y * wordsOfRow + pixel.x / 32).x;
    float isLit = float(word >> uint(pixel.x % 32) & 1u);
    imageStore(visibility, ivec3(pixel, lightIndex), vec4(isLit));
}
