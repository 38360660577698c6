// SPDX-License-Identifier: MIT
// A map in 64-bit fixed point (CausticMap, InScattered), of which the sums depend neither on the
// order nor on the batches in which light arrives (hard case 34: a plain 32-bit sum of 2^25 deposits
// is 15 % off). The unit of flux is the ledger's.
#include "include/photons/ledger_unit.glsl"
#include "framework/transport/types.h"

layout(r32ui) uniform uimage2DArray fluxSums;

// The low and the high word of so many units, rounded to the nearest, so that a great many small
// deposits are right on the whole. What is not a number, or negative, is nothing: whoever deposits has
// checked.
uvec2 wordsOfUnits(float units) {
    // A float has 24 bits, so that both words are exact.
    float whole = floor(units + 0.5);
    if (!(whole > 0.0)) return uvec2(0u);
    float high = floor(whole * (1.0 / 4294967296.0));
    return uvec2(uint(whole - high * 4294967296.0), uint(high));
}

// What is added to the high word, once the low one, which was `before`, has been added to.
uint highAddend(uvec2 words, uint before) {
    return words.y + (before > 0xffffffffu - words.x ? 1u : 0u);
}

// Adds to the word and the one above it.
void sumAddTo(ivec3 word, float units) {
    uvec2 words = wordsOfUnits(units);
    if (words == uvec2(0u)) return;
    uint above = highAddend(words, imageAtomicAdd(fluxSums, word, words.x));
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
