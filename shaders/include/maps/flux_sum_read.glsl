// SPDX-License-Identifier: MIT
// A map of flux to read: see include/maps/flux_sum.glsl.
#include "include/photons/ledger_unit.glsl"
#include "framework/transport/types.h"

uniform usampler2DArray fluxSums;

const uint kFluxPart = 0u;
const uint kIntensityPart = 1u;

uvec2 fluxWordsAt(ivec3 word) {
    return uvec2(texelFetch(fluxSums, word, 0).x, texelFetch(fluxSums, word + ivec3(0, 0, 1), 0).x);
}

// In units, of one of the maps that a texture holds.
vec3 sumAt(ivec2 texel, int map) {
    vec3 units;
    for (int channel = 0; channel < 3; ++channel) {
        uvec2 words = fluxWordsAt(ivec3(texel, int(kFluxWords) * map + 2 * channel));
        units[channel] = float(words.y) * 4294967296.0 + float(words.x);
    }
    return units;
}

// W, or W/sr; of a cube's face `face` the flux.
vec3 fluxAt(ivec2 texel, uint part, int face) {
    return sumAt(texel, int(part) + face) *
           (part == kFluxPart ? 1.0 : kIntensityQuantum) / ledgerUnitsPerWatt;
}

vec3 fluxAt(ivec2 texel, uint part) {
    return fluxAt(texel, part, 0);
}
