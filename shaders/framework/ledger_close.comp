// SPDX-License-Identifier: MIT
// Closes the ledger of a frame: sums what the maps of flux hold, one a view. A thread a texel.
#include "include/photons/ledger_of_group.glsl"
#include "include/maps/flux_sum_read.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform int mapCount;
uniform int wordsPerMap;
uniform int parts;  // sets of flux that count

void threadMain() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, textureSize(fluxSums, 0).xy))) return;
    bool isLit = false;
    for (int map = 0; map < mapCount; ++map) {
        for (int channel = 0; channel < 3 * parts; ++channel) {
            uvec2 words = fluxWordsAt(ivec3(texel, map * wordsPerMap + 2 * channel));
            if (words == uvec2(0u)) continue;
            isLit = true;
            ledgerAddUnits(kAccountDeposited, words.x, words.y);
        }
    }
    if (isLit) ledgerAddEvent(kAccountDeposited);
}
