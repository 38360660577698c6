// SPDX-License-Identifier: MIT
// A map in 64-bit fixed point (CausticMap, InScattered), of which the sums depend neither on the
// order nor on the batches in which light arrives (hard case 34: a plain 32-bit sum of 2^25 deposits
// is 15 % off). The unit of flux is the ledger's.
#include "include/ledger_unit.glsl"
#include "framework/transport/types.h"

layout(r32ui) uniform uimage2DArray fluxSums;

const uint kFluxPart = 0u;
const uint kIntensityPart = 1u;  // W/sr towards the eye

// Adds to the map `map` of a texture that holds several. Rounded to the nearest unit, so that a
// great many small deposits are right on the whole. What is not a number, or negative, adds nothing:
// whoever deposits has checked.
void sumAdd(ivec2 texel, int map, vec3 units) {
    for (int channel = 0; channel < 3; ++channel) {
        // A float has 24 bits, so that both words are exact.
        float whole = floor(units[channel] + 0.5);
        if (!(whole > 0.0)) continue;
        float high = floor(whole * (1.0 / 4294967296.0));
        uint low = uint(whole - high * 4294967296.0);
        ivec3 word = ivec3(texel, int(kFluxWords) * map + 2 * channel);
        uint before = imageAtomicAdd(fluxSums, word, low);
        uint above = uint(high) + (before > 0xffffffffu - low ? 1u : 0u);
        if (above > 0u) imageAtomicAdd(fluxSums, word + ivec3(0, 0, 1), above);
    }
}

// `face`: of a cube, of which each has a map.
void fluxAdd(ivec2 texel, int face, uint part, vec3 amount) {
    vec3 units = amount * (part == kFluxPart ? ledgerUnitsPerWatt
                                             : ledgerUnitsPerWatt / kIntensityQuantum);
    sumAdd(texel, int(part) + face, units);
}

void fluxAdd(ivec2 texel, uint part, vec3 amount) {
    fluxAdd(texel, 0, part, amount);
}
