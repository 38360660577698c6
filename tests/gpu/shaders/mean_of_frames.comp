// SPDX-License-Identifier: MIT
// rgb: the sum over all frames so far; a: how many they are.
#include "include/maps/flux_sum_read.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D receiver;
layout(rgba32f) uniform image2D sumAndCount;
layout(rgba32f) writeonly uniform image2D mean;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(mean)))) return;
    float area = texelFetch(receiver, pixel, 0).y;
    vec3 now = area > 0.0 ? fluxAt(pixel, kFluxPart) / area : vec3(0.0);
    vec4 sum = imageLoad(sumAndCount, pixel) + vec4(now, 1.0);
    imageStore(sumAndCount, pixel, sum);
    imageStore(mean, pixel, vec4(sum.rgb / sum.a, 0.0));
}
