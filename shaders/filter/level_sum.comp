// SPDX-License-Identifier: MIT
// filter.level_sum: what all levels of a multi-resolution map hold of each texel, bilinear between
// the coarser ones' (WN09, section 3.2.2).
#include "maps/filtered.glsl"
#include "maps/sample_level.glsl"

uniform int levels;

void main() {
    ivec2 texel;
    if (!texelOfThread(texel)) return;
    for (int view = 0; view < views; ++view) {
        for (int kind = 0; kind < setsAfter; ++kind) {
            vec3 sum = vec3(0.0);
            for (int level = 0; level < levels; ++level)
                sum += sampleLevel(texel, level, firstSet(view, kind));
            storeFiltered(texel, view, kind, sum);
        }
    }
}
