// SPDX-License-Identifier: MIT
// A map of flux to read, and the one that a filter makes of it. One thread a texel.
#include "include/flux_sum_read.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(r32ui) writeonly uniform uimage2DArray filteredSums;

uniform int setsBefore;  // of a view
uniform int setsAfter;
uniform int views;

bool texelOfThread(out ivec2 texel) {
    texel = ivec2(gl_GlobalInvocationID.xy);
    return all(lessThan(texel, textureSize(fluxSums, 0).xy));
}

void storeWord(ivec3 word, float units) {
    float whole = floor(units + 0.5);
    if (!(whole > 0.0)) whole = 0.0;
    // A float has 24 bits, so that both words are exact.
    float high = floor(whole * (1.0 / 4294967296.0));
    imageStore(filteredSums, word, uvec4(uint(whole - high * 4294967296.0)));
    imageStore(filteredSums, word + ivec3(0, 0, 1), uvec4(uint(high)));
}

void storeSum(ivec2 texel, int map, vec3 units) {
    for (int channel = 0; channel < 3; ++channel)
        storeWord(ivec3(texel, int(kFluxWords) * map + 2 * channel), units[channel]);
}

// The sets after the flux itself are kept as they are.
void keepOthers(ivec2 texel, int fluxSetsBefore) {
    for (int view = 0; view < views; ++view) {
        for (int set = 1; set < setsAfter; ++set) {
            vec3 units = sumAt(texel, view * setsBefore + fluxSetsBefore + set - 1);
            storeSum(texel, view * setsAfter + set, units);
        }
    }
}
