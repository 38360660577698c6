// SPDX-License-Identifier: MIT
// The most fragments that one object has in a pixel.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D counts;
uniform int object;
layout(std430) buffer Complexities {
    uint complexities[];
};

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, textureSize(counts, 0)))) return;
    uint count = uint(texelFetch(counts, pixel, 0).x);
    if (count > 0u) atomicMax(complexities[object], count);
}
