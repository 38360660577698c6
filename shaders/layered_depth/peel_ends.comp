// SPDX-License-Identifier: MIT
// Stores a depth of 0 in every layer that a pixel of the workgroup has, and in the one behind the
// last, before layers are drawn over it (LayeredDepth): by the fragments that each pixel has, of
// which those at one depth give one layer. One thread a pixel.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D counts;
layout(rgba32f) writeonly uniform image2DArray layerDepths;
uniform int layerCount;

shared int most;  // fragments of a pixel of the workgroup

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool isPixel = all(lessThan(pixel, textureSize(counts, 0)));
    if (gl_LocalInvocationIndex == 0u) most = 0;
    barrier();
    if (isPixel) atomicMax(most, int(texelFetch(counts, pixel, 0).x));
    barrier();
    int end = isPixel ? min(most + 1, layerCount) : 0;
    for (int layer = 0; layer < end; ++layer)
        imageStore(layerDepths, ivec3(pixel, layer), vec4(0.0));
}
