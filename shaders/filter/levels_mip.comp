// SPDX-License-Identifier: MIT
// filter.levels: one level of the map's mip chain from the one before, flux and counts: what four
// texels hold together. One thread a texel of the level.
#include "maps/levels.glsl"
#include "framework/transport/types.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(r32ui) uniform uimage2DArray fluxSums;
layout(r32ui) uniform uimage2DArray photonCounts;

uniform int level;
uniform int views;
uniform int setsBefore;
uniform int fluxSets;  // the first of them; what is kept for glossy receivers follows

// What four texels hold together, of flux or of what is kept for glossy receivers. `first`: the set
// of level 0.
void addUp(ivec2 texel, ivec2 from, ivec2 to, int first) {
    int wordsFrom = int(kFluxWords) * (first + setOfLevel(level - 1));
    int wordsTo = int(kFluxWords) * (first + setOfLevel(level));
    for (int channel = 0; channel < 3; ++channel) {
        uint low = 0u;
        uint high = 0u;
        for (int i = 0; i < 4; ++i) {
            ivec2 child = 2 * texel + ivec2(i & 1, i >> 1);
            if (any(greaterThanEqual(child, sizeOfLevel(level - 1)))) continue;
            ivec3 word = ivec3(from + child, wordsFrom + 2 * channel);
            uint added = imageLoad(fluxSums, word).x;
            high += imageLoad(fluxSums, word + ivec3(0, 0, 1)).x + (low + added < low ? 1u : 0u);
            low += added;
        }
        ivec3 word = ivec3(to, wordsTo + 2 * channel);
        imageStore(fluxSums, word, uvec4(low));
        imageStore(fluxSums, word + ivec3(0, 0, 1), uvec4(high));
    }
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, sizeOfLevel(level)))) return;
    ivec2 from = placeOfLevel(level - 1);
    ivec2 to = placeOfLevel(level) + texel;
    for (int view = 0; view < views; ++view) {
        for (int first = 0; first < setsBefore; first += fluxSets)
            addUp(texel, from, to, view * setsBefore + first);
        uint photons = 0u;
        for (int i = 0; i < 4; ++i) {
            ivec2 child = 2 * texel + ivec2(i & 1, i >> 1);
            if (any(greaterThanEqual(child, sizeOfLevel(level - 1)))) continue;
            photons += imageLoad(photonCounts,
                                 ivec3(from + child, 2 * view + setOfLevel(level - 1))).x;
        }
        imageStore(photonCounts, ivec3(to, 2 * view + setOfLevel(level)), uvec4(photons));
    }
}
