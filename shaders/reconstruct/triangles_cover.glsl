// SPDX-License-Identifier: MIT
// A patch is covered in two steps: what all places have of it is added up, and then each gets its
// share of that. What has been found in the first is kept for the second, as far as there is room.
#include "reconstruct/triangles_patch_deposit.glsl"
#include "reconstruct/triangles_walk.glsl"

#ifndef MANY_VIEWS
const uint kMaxKept = 24u;
shared uint keptPlaces[64u * kMaxKept];
shared float keptShares[64u * kMaxKept];
uint keptAt(uint number) { return 64u * number + gl_LocalInvocationIndex; }
#endif

// By one thread.
struct Found {
    PatchParts parts;
    float excess;  // of what is stored over what is lit
    uint kept;     // places
    Walk rest;     // where it was when there was no more room
};
Found nothingFound() {
    Found found;
    found.parts = PatchParts(0.0, 0.0, 0.0);
    found.excess = 0.0;
    found.kept = 0u;
    return found;
}

// A pixel, or a square of pixels.
const uint kBlockPlace = 0x80000000u;
uint placeOf(Walk walk) {
#ifdef WALKS_BLOCKS
    if (isAtBlock(walk)) return kBlockPlace | uint(blockAt(walk.pixel));
#endif
    return uint(walk.pixel.y) << 16u | uint(walk.pixel.x);
}

void keep(inout Found found, Walk walk, float stored) {
#ifndef MANY_VIEWS
    if (stored <= 0.0 || found.kept == kMaxKept) return;
    keptPlaces[keptAt(found.kept)] = placeOf(walk);
    keptShares[keptAt(found.kept)] = stored;
    ++found.kept;
    if (found.kept == kMaxKept) found.rest = walk;
#endif
}

// What is on every `step`th line from the first one on.
void findParts(Patch whole, PatchOnScreen onto, int first, int step, inout Found found) {
    Walk walk = walkOver(whole, onto, first, step);
    PlanePixel sum = PlanePixel(0.0, 0.0, 0.0, 0.0);
    bool isThere = goOn(walk, onto);
    do {
        if (!isThere) break;
        addPlace(onto, walk, sum);
        if (isAtLastPart(walk)) {
            addPart(found.parts, sum);
            found.excess += sum.stored - sum.lit;
            keep(found, walk, sum.stored);
            sum = PlanePixel(0.0, 0.0, 0.0, 0.0);
        }
        isThere = goOn(walk, onto);
    } while (isThere);
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
#ifdef MANY_VIEWS
    Walk walk = walkOver(whole, onto, first, step);
#else
    uint i = 0u;
    do {
        if (i < found.kept) depositAt(whole, keptPlaces[keptAt(i)], keptShares[keptAt(i)] / total);
    } while (++i < found.kept);
    if (found.kept < kMaxKept) return;
    Walk walk = found.rest;
#endif
    PlanePixel sum = PlanePixel(0.0, 0.0, 0.0, 0.0);
    bool isThere = goOn(walk, onto);
    do {
        if (!isThere) break;
        addPlace(onto, walk, sum);
        if (isAtLastPart(walk)) {
            if (sum.stored > 0.0) depositAt(whole, placeOf(walk), sum.stored / total);
            sum = PlanePixel(0.0, 0.0, 0.0, 0.0);
        }
        isThere = goOn(walk, onto);
    } while (isThere);
}
