// SPDX-License-Identifier: MIT
// Adds the sums of one batch of photons to those of all, with the compensation of Kahan: `carryMap`
// is what rounding has made them too large by. Empties the batch.
layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) uniform image2D batchMap;
layout(rgba32f) uniform image2D carryMap;
layout(rgba32f) uniform image2D sumMap;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(sumMap)))) return;
    vec4 batch = imageLoad(batchMap, pixel);
    if (batch == vec4(0.0)) return;
    vec4 before = imageLoad(sumMap, pixel);
    precise vec4 added = batch - imageLoad(carryMap, pixel);
    precise vec4 sum = before + added;
    precise vec4 carry = (sum - before) - added;
    imageStore(sumMap, pixel, sum);
    imageStore(carryMap, pixel, carry);
    imageStore(batchMap, pixel, vec4(0.0));
}
