// SPDX-License-Identifier: MIT
// What a reconstruction has to cover: a photon's index and which part of its light.

// How many there are, and the arguments of an indirect dispatch over them.
struct PatchCount {
    uint count;
    uint groupsX;
    uint groupsY;
    uint groupsZ;
};

const uint kPatchQuarter = 0u;  // 0 to 3: of its beam, by the cell beside it: right, up: bits
const uint kPatchBeam = 4u;     // all of its beam
const uint kPatchJoined = 5u;   // what it is the lower left corner of
const uint kPatchCrease = 8u;   // 8 to 11: the same of where light comes down on several surfaces
const uint kPatchParts = 16u;
