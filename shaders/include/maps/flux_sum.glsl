// SPDX-License-Identifier: MIT
// A map in 64-bit fixed point (CausticMap, InScattered), of which the sums depend neither on the
// order nor on the batches in which light arrives (hard case 34: a plain 32-bit sum of 2^25 deposits
// is 15 % off). The unit of flux is the ledger's.
#include "include/photons/ledger_unit.glsl"
#include "framework/transport/types.h"

layout(r32ui) uniform uimage2DArray fluxSums;

// Adds to the word and the one above it. Rounded to the nearest unit, so that a great many small
// deposits are right on the whole. What is not a number, or negative, adds nothing: whoever deposits
// has checked.
void sumAddTo(ivec3 word, float units) {
    // A float has 24 bits, so that both words are exact.
    float whole = floor(units + 0.5);
    if (!(whole > 0.0)) return;
    float high = floor(whole * (1.0 / 4294967296.0));
    uint low = uint(whole - high * 4294967296.0);
    uint before = imageAtomicAdd(fluxSums, word, low);
    uint above = uint(high) + (before > 0xffffffffu - low ? 1u : 0u);
    if (above > 0u) imageAtomicAdd(fluxSums, word + ivec3(0, 0, 1), above);
}

// Adds to the map `map` of a texture that holds several. No loop: its turns would count among those
// of a splat, of which Mesa's software rasteriser has a thread make no more than 65,535.
void sumAdd(ivec2 texel, int map, vec3 units) {
    ivec3 word = ivec3(texel, int(kFluxWords) * map);
    sumAddTo(word, units.r);
    sumAddTo(word + ivec3(0, 0, 2), units.g);
    sumAddTo(word + ivec3(0, 0, 4), units.b);
}
