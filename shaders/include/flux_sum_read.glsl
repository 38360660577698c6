// SPDX-License-Identifier: MIT
// A map of flux to read: see include/flux_sum.glsl.
#include "include/ledger_unit.glsl"
#include "framework/transport/types.h"

uniform usampler2DArray fluxSums;

const uint kFluxPart = 0u;
const uint kIntensityPart = 1u;

uvec2 fluxWords(ivec2 texel, uint part, int channel) {
    ivec3 word = ivec3(texel, int(kFluxWords * part) + 2 * channel);
    return uvec2(texelFetch(fluxSums, word, 0).x, texelFetch(fluxSums, word + ivec3(0, 0, 1), 0).x);
}

// W, or W/sr.
vec3 fluxAt(ivec2 texel, uint part) {
    vec3 units;
    for (int channel = 0; channel < 3; ++channel) {
        uvec2 words = fluxWords(texel, part, channel);
        units[channel] = float(words.y) * 4294967296.0 + float(words.x);
    }
    return units * (part == kFluxPart ? 1.0 : kIntensityQuantum) / ledgerUnitsPerWatt;
}
