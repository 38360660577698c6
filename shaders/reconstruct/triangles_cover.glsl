// SPDX-License-Identifier: MIT
// A patch is covered in two steps: what all places have of it is added up, and then each gets its
// share of that. What has been found in the first is kept for the second, as far as there is room.
#include "reconstruct/triangles_patch_deposit.glsl"
#include "reconstruct/triangles_walk.glsl"

// By one thread.
struct Found {
    PatchParts parts;
    float excess;  // of what is stored over what is lit
    uint kept;     // places; more than kMaxKept: not all of them
};
const Found kNothingFound = Found(PatchParts(0.0, 0.0, 0.0), 0.0, 0u);

const uint kMaxKept = 32u;
#ifndef MANY_VIEWS
shared uint keptPlaces[64u * kMaxKept];
shared float keptShares[64u * kMaxKept];
uint keptAt(uint number) { return 64u * number + gl_LocalInvocationIndex; }
#endif

// A pixel, or a square of pixels.
const uint kBlockPlace = 0x80000000u;
uint placeOf(Walk walk) {
#ifdef WALKS_BLOCKS
    if (isAtBlock(walk)) return kBlockPlace | uint(blockAt(walk.pixel));
#endif
    return uint(walk.pixel.y) << 16u | uint(walk.pixel.x);
}

void keep(inout Found found, uint place, float stored) {
#ifndef MANY_VIEWS
    if (stored <= 0.0) return;
    if (found.kept < kMaxKept) {
        keptPlaces[keptAt(found.kept)] = place;
        keptShares[keptAt(found.kept)] = stored;
    }
    ++found.kept;
#endif
}

// What is on every `step`th line from the first one on.
void findParts(Patch whole, PatchOnScreen onto, int first, int step, inout Found found) {
    Walk walk = walkOver(whole, onto, first, step);
    PlanePixel sum = PlanePixel(0.0, 0.0, 0.0, 0.0);
    while (goOn(walk, onto)) {
        addPlace(onto, walk, sum);
        if (!isAtLastPart(walk)) continue;
        addPart(found.parts, sum);
        found.excess += sum.stored - sum.lit;
        keep(found, placeOf(walk), sum.stored);
        sum = PlanePixel(0.0, 0.0, 0.0, 0.0);
    }
}

#ifdef WALKS_BLOCKS
// As sumAddTo() adds to a map.
void addToBlock(uint block, int channel, float units) {
    uvec2 words = wordsOfUnits(units);
    if (words == uvec2(0u)) return;
    uint above = highAddend(words, atomicAdd(pixelBlocks[block].sums[2 * channel], words.x));
    if (above > 0u) atomicAdd(pixelBlocks[block].sums[2 * channel + 1], above);
}
#endif

void depositAt(Patch whole, uint place, float share) {
#ifdef WALKS_BLOCKS
    if ((place & kBlockPlace) != 0u) {
        vec3 units = whole.flux * (share * ledgerUnitsPerWatt);
        for (int channel = 0; channel < 3; ++channel)
            addToBlock(place & ~kBlockPlace, channel, units[channel]);
        return;
    }
#endif
    deposit(whole, ivec2(place & 0xffffu, place >> 16u), share);
}

// Of shares that add up to `total`.
void depositParts(Patch whole, PatchOnScreen onto, int first, int step, float total, Found found) {
#ifndef MANY_VIEWS
    if (found.kept <= kMaxKept) {
        for (uint i = 0u; i < found.kept; ++i)
            depositAt(whole, keptPlaces[keptAt(i)], keptShares[keptAt(i)] / total);
        bookMapExcess(whole, found.excess / total);
        return;
    }
#endif
    float excess = 0.0;
    Walk walk = walkOver(whole, onto, first, step);
    PlanePixel sum = PlanePixel(0.0, 0.0, 0.0, 0.0);
    while (goOn(walk, onto)) {
        addPlace(onto, walk, sum);
        if (!isAtLastPart(walk)) continue;
        if (sum.stored > 0.0) depositAt(whole, placeOf(walk), sum.stored / total);
        excess += sum.stored - sum.lit;
        sum = PlanePixel(0.0, 0.0, 0.0, 0.0);
    }
    bookMapExcess(whole, excess / total);
}
