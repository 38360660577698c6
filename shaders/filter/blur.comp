// SPDX-License-Identifier: MIT
// filter.blur: a Gaussian over the map's texels, along x and then along y (WD06). What would fall
// next to the map stays in it: each texel's weights are normalised over those that are there, so that
// no flux is lost, and a splat of the same Gaussian gives the same.
#include "maps/filtered.glsl"

layout(rgba32f) uniform image2DArray blurred;  // units, along x alone

uniform int diameter;  // texels, odd
uniform int axis;

float gaussian(int offset) {
    float share = 2.0 * float(offset) / float(diameter);
    return exp(-4.5 * share * share);
}

// What a texel at `from`'s weights sum to.
float sumOfWeights(int from, int size) {
    float sum = 0.0;
    int reach = diameter / 2;
    for (int i = -reach; i <= reach; ++i) {
        if (from + i >= 0 && from + i < size) sum += gaussian(i);
    }
    return sum;
}

vec3 valueAt(ivec2 texel, int layer) {
    return axis == 0 ? sumAt(texel, layer) : imageLoad(blurred, ivec3(texel, layer)).rgb;
}

void main() {
    ivec2 texel;
    if (!texelOfThread(texel)) return;
    int size = textureSize(fluxSums, 0)[axis];
    int reach = diameter / 2;
    ivec2 step = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
    for (int layer = 0; layer < views * setsBefore; ++layer) {
        vec3 sum = vec3(0.0);
        for (int i = -reach; i <= reach; ++i) {
            int from = texel[axis] + i;
            if (from < 0 || from >= size) continue;
            sum += valueAt(texel + i * step, layer) * (gaussian(i) / sumOfWeights(from, size));
        }
        if (axis == 0) {
            imageStore(blurred, ivec3(texel, layer), vec4(sum, 0.0));
        } else {
            storeFiltered(texel, layer / setsBefore, layer % setsBefore, sum);
        }
    }
}
