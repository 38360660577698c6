// SPDX-License-Identifier: MIT
// The most fragments that one object has in a pixel, of those that may show it, and their sum with
// those of the objects before.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D counts;
layout(r32f) uniform image2D allCounts;
uniform int object;
uniform ivec2 firstPixel;
uniform ivec2 endPixel;
layout(std430) buffer Complexities {
    uint complexities[];
};

void main() {
    ivec2 pixel = firstPixel + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, endPixel))) return;
    float count = texelFetch(counts, pixel, 0).x;
    if (count <= 0.0) return;
    atomicMax(complexities[object], uint(count));
    imageStore(allCounts, pixel, imageLoad(allCounts, pixel) + vec4(count, 0.0, 0.0, 0.0));
}
