// SPDX-License-Identifier: MIT
// What the walk from the top of the mip map reads and writes: for each level the squares that it
// looks at, without gaps, and the photons that are stored.
#include "driver/hierarchical.glsl"

struct WalkSquare {
    uint node;   // of its level
    uint first;  // place of its first photon among those that are stored
};

layout(std430) buffer WalkSquares {
    WalkSquare squares[];  // of a level from its first node on
};
layout(std430) buffer WalkLists {
    PhotonList walkLists[];  // by level, how many of its squares are looked at
};
