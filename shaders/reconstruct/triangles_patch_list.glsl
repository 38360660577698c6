// SPDX-License-Identifier: MIT
// What a reconstruction has to cover: a photon's index and which part of its light.

#include "include/thread_list.glsl"

// They are made by shaders of their own, since they have little in common.
const uint kPatchesJoined = 0u;
const uint kPatchesOfBeams = 1u;
const uint kPatchesAtCreases = 2u;
const uint kPatchKinds = 3u;

// Wide ones go to pixels or to squares of them, which have as little in common.
const uint kWideToPixels = 0u;
const uint kWideToSquares = 1u;
const uint kWideKinds = 2u;

layout(std430) buffer Patches {
    ThreadList patches[kPatchKinds];
    ThreadList copiedPatches[kPatchKinds];  // of those, what is laid more than once
                                            // (triangles_spread.glsl)
    ThreadList widePatches[kWideKinds];     // and what is wide (triangles_wide.glsl)
    uint patchList[];
};

// At most one is joined a photon, and no more than four are not: beams from the begin of their part
// of the list, those at creases from its end.
uint patchPlace(uint kind, uint number, uint capacity) {
    if (kind == kPatchesJoined) return number;
    return kind == kPatchesOfBeams ? capacity + number : 5u * capacity - 1u - number;
}

// In the second part of the list, where there is one.
uint copiedPatchPlace(uint kind, uint number, uint capacity) {
    return 5u * capacity + patchPlace(kind, number, capacity);
}

// `capacity`: of each kind.
uint widePlace(uint kind, uint number, uint capacity) { return kind * capacity + number; }

// That share a patch's copies: Mesa's software rasteriser has a thread turn no more than 65,535 times
// in all of its loops.
const uint kThreadsOfCopies = 16u;

// Of a wide one.
const uint kThreadsOfPatch = 8u;

const uint kPatchQuarter = 0u;  // 0 to 3: of its beam, by the cell next to it: right, up: bits
const uint kPatchBeam = 4u;     // all of its beam
const uint kPatchJoined = 5u;   // what it is the lower left corner of
const uint kPatchCrease = 8u;   // 8 to 11: the same of where light comes down on several surfaces
const uint kPatchMerged = 12u;  // 12 to 15: 2, 4, 8 and 16 such cells along each side, as one
// The same numbers, since that is in the list of what is joined alone.
const uint kPatchHalf = 12u;  // 12 to 15: halves of its beam, below, above, left and right
const uint kMaxMerges = 4u;
const uint kPatchParts = 16u;

// Bits of the quarters that a half is made of.
uint quartersOfHalf(uint side) {
    const uint kQuarters[4] = uint[4](3u, 12u, 5u, 10u);
    return kQuarters[side];
}

// What a photon's flux is shared out by.
struct VertexShares {
    float quarter;    // of its flux that a whole quarter of its cell takes
    float area;       // of all triangles that it is a corner of, m² (U08, section 5)
    float triangles;  // how many
    float cells;      // of those that are joined, how many it is a corner of
};

// A square of joined cells, by the photon at its lower left.
struct PatchBlock {
    vec4 flux;  // rgb: W; w: its side is 2^w cells; -1: it is none, or part of a larger one
    vec4 low;   // xyz: the box around it in the view, px; of a cube in directions, times px
    vec4 high;
};
