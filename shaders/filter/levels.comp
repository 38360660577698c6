// SPDX-License-Identifier: MIT
// filter.levels: of each texel the finest level on whose texel enough photons lie (WD08, section
// 4), bilinear between that level's texels.
#include "maps/filtered.glsl"
#include "maps/sample_level.glsl"

uniform usampler2DArray photonCounts;
uniform int levels;

uint countAt(ivec2 texel, int level, int view) {
    return texelFetch(photonCounts,
                      ivec3(placeOfLevel(level) + texel, 2 * view + setOfLevel(level)), 0).x;
}

void main() {
    ivec2 texel;
    if (!texelOfThread(texel)) return;
    for (int view = 0; view < views; ++view) {
        int chosen = levels - 1;
        for (int level = levels - 1; level >= 0; --level) {
            if (countAt(texel >> level, level, view) >= uint(filter_levels_min_photons)) chosen = level;
        }
        for (int kind = 0; kind < setsAfter; ++kind)
            storeFiltered(texel, view, kind, sampleLevel(texel, chosen, firstSet(view, kind)));
    }
}
