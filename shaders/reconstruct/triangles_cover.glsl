// SPDX-License-Identifier: MIT
// A patch is covered in two steps: what all places have of it is added up, and then each gets its
// share of that. What has been found in the first is kept for the second, as far as there is room.
#include "reconstruct/triangles_patch_deposit.glsl"
#include "reconstruct/triangles_walk.glsl"

#ifndef MANY_VIEWS
const uint kMaxKept = 24u;
shared uint keptPlaces[64u * kMaxKept];
shared float keptShares[64u * kMaxKept];
uint keptAt(uint thread, uint number) { return 64u * number + thread; }
#endif

// By one thread.
struct Found {
    PatchParts parts;
    float excess;      // of what is stored over what is lit
    uint keptPixels;   // from the first place on
    uint keptSquares;  // from the last one down
    Walk rest;         // where it was when there was no more room
};
Found nothingFound() {
    Found found;
    found.parts = PatchParts(0.0, 0.0, 0.0);
    found.excess = 0.0;
    found.keptPixels = 0u;
    found.keptSquares = 0u;
    return found;
}

#ifndef MANY_VIEWS
bool isFull(Found found) { return found.keptPixels + found.keptSquares == kMaxKept; }
#endif

uint placeOf(ivec2 pixel) { return uint(pixel.y) << 16u | uint(pixel.x); }

void keep(inout Found found, Walk walk, float stored) {
#ifndef MANY_VIEWS
    if (stored <= 0.0 || isFull(found)) return;
    uint place = placeOf(walk.pixel);
    uint number = found.keptPixels;
#ifdef WALKS_BLOCKS
    if (isAtBlock(walk)) {
        place = uint(blockAt(walk.pixel));
        number = kMaxKept - 1u - found.keptSquares++;
    } else
#endif
        ++found.keptPixels;
    uint at = keptAt(gl_LocalInvocationIndex, number);
    keptPlaces[at] = place;
    keptShares[at] = stored;
    if (isFull(found)) found.rest = walk;
#endif
}

// What is on every `step`th line from the first one on.
void findParts(PatchOnScreen onto, int first, int step, inout Found found) {
    Walk walk = walkOver(onto, first, step);
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

void depositInSquare(uint block, vec3 flux) {
    vec3 units = flux * ledgerUnitsPerWatt;
    for (int channel = 0; channel < 3; ++channel) addToBlock(block, channel, units[channel]);
}
#endif

#ifndef MANY_VIEWS
// Threads that deposit together what each has kept: one that has found much would keep the others
// waiting.
#ifdef COPIES
const uint kKeepers = 1u;
#else
const uint kKeepers = 8u;
#endif
struct KeptFlux {
    vec3 flux;  // W, over what the shares add up to
    vec3 direction;
};
shared KeptFlux keptFlux[64];
shared uint keptCounts[64];

// How many pixels and squares the threads up to each have, from these bits on.
const uint kPixelBits = 0u;
const uint kSquareBits = 16u;
struct KeptCounts {
    uint first;
    uint upTo[kKeepers];
};

KeptCounts countKept(uint pixels, uint squares) {
    keptCounts[gl_LocalInvocationIndex] = squares << kSquareBits | pixels << kPixelBits;
#ifndef COPIES
    barrier();
#endif
    KeptCounts counts;
    counts.first = gl_LocalInvocationIndex / kKeepers * kKeepers;
    uint sum = 0u;
    for (uint i = 0u; i < kKeepers; ++i) {
        sum += keptCounts[counts.first + i];
        counts.upTo[i] = sum;
    }
    return counts;
}

uint countOf(uint both, uint bits) { return both >> bits & 0xffffu; }

// How many they have together.
uint countOf(KeptCounts counts, uint bits) { return countOf(counts.upTo[kKeepers - 1u], bits); }

// The thread that has one of them, and its number there.
uvec2 keeperOf(KeptCounts counts, uint bits, uint index) {
    uvec2 keeper = uvec2(counts.first, index);
    for (uint i = 0u; i + 1u < kKeepers; ++i) {
        uint before = countOf(counts.upTo[i], bits);
        if (index >= before) keeper = uvec2(counts.first + i + 1u, index - before);
    }
    return keeper;
}

// Of one place that a thread has kept. The same to the bit in each program that a compiler makes of it.
vec3 keptFluxAt(uint thread, uint at) {
    precise vec3 flux = keptFlux[thread].flux * keptShares[at];
    return flux;
}

void depositKeptPixel(uvec2 keeper) {
    uint at = keptAt(keeper.x, keeper.y);
    uint place = keptPlaces[at];
    depositFlux(ivec2(place & 0xffffu, place >> 16u), keptFluxAt(keeper.x, at),
                directionToEye(keptFlux[keeper.x].direction));
}

#ifdef WALKS_BLOCKS
void depositKeptSquare(uvec2 keeper) {
    uint at = keptAt(keeper.x, kMaxKept - 1u - keeper.y);
    depositInSquare(keptPlaces[at], keptFluxAt(keeper.x, at));
}
#endif

// By all threads of a workgroup at once (COPIES: by each alone). `found` and `total`, which the
// shares add up to, are of what the thread itself has found; 0: nothing is to be deposited.
void depositKept(Patch whole, float total, Found found) {
    bool isDeposited = total > 0.0;
    if (isDeposited)
        keptFlux[gl_LocalInvocationIndex] = KeptFlux(whole.flux / total, whole.side.direction);
    KeptCounts counts = countKept(isDeposited ? found.keptPixels : 0u,
                                  isDeposited ? found.keptSquares : 0u);
    // They ask within, since a software rasteriser goes through a loop at least once.
    uint first = gl_LocalInvocationIndex % kKeepers;
    uint pixels = countOf(counts, kPixelBits);
    uint i = first;
    do {
        if (i < pixels) depositKeptPixel(keeperOf(counts, kPixelBits, i));
        i += kKeepers;
    } while (i < pixels);
#ifdef WALKS_BLOCKS
    uint squares = countOf(counts, kSquareBits);
    i = first;
    do {
        if (i < squares) depositKeptSquare(keeperOf(counts, kSquareBits, i));
        i += kKeepers;
    } while (i < squares);
#endif
}
#endif

// What has not been kept, by each thread alone.
void depositRest(Patch whole, PatchOnScreen onto, int first, int step, float total, Found found) {
#ifdef MANY_VIEWS
    Walk walk = walkOver(onto, first, step);
#else
    if (!isFull(found)) return;
    Walk walk = found.rest;
#endif
    PlanePixel sum = PlanePixel(0.0, 0.0, 0.0, 0.0);
    bool isThere = goOn(walk, onto);
    do {
        if (!isThere) break;
        addPlace(onto, walk, sum);
        if (isAtLastPart(walk)) {
            float share = sum.stored / total;
#ifdef WALKS_BLOCKS
            if (sum.stored > 0.0 && isAtBlock(walk)) {
                depositInSquare(uint(blockAt(walk.pixel)), whole.flux * share);
            } else
#endif
                if (sum.stored > 0.0) deposit(whole, walk.pixel, share);
            sum = PlanePixel(0.0, 0.0, 0.0, 0.0);
        }
        isThere = goOn(walk, onto);
    } while (isThere);
}
