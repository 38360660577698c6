// SPDX-License-Identifier: MIT
// A step of the walk from the top of the mip map (W08). Of the squares of a level that it has come
// to, one that a photon will do for is stored as its middle photon; of the others those of the four
// squares below that hold photons are the next level's, or their own photons are stored. One thread
// a square.
#include "light_cells/cell_lists.glsl"
#include "driver/hierarchical_walk.glsl"
#include "include/thread.glsl"

layout(std430) readonly buffer CellPhotons {
    uint cellPhotons[];  // + 1
};
layout(std430) writeonly buffer StoredPhotons {
    StoredPhoton storedPhotons[];
};
uniform int level;
uniform ivec2 size;  // of the level, squares
uniform ivec2 sizeBelow;
uniform int first;   // node of the level
uniform int firstBelow;
uniform int merges;  // 1: squares of this level may be one photon
uniform float tolerance;

void main() {
    uint index = threadNumber();
    if (index >= walkLists[level].count) return;
    WalkSquare square = squares[uint(first) + index];
    HierarchyNode node = nodes[uint(first) + square.node];
    if (merges == 1 && isOnePhoton(node, tolerance)) {
        storedPhotons[square.first] =
            StoredPhoton(node.middle - 1u, uint(first) + square.node + 1u, uint(level));
        atomicAdd(counting.merged, 1u);
        return;
    }
    int perGrid = size.x * size.y;
    int grid = int(square.node) / perGrid;
    ivec2 here = ivec2(int(square.node) % size.x, int(square.node) % perGrid / size.x);
    uint place = square.first;
    for (int i = 0; i < 4; ++i) {
        ivec2 child = 2 * here + ivec2(i & 1, i >> 1);
        if (any(greaterThanEqual(child, sizeBelow))) continue;
        int at = (grid * sizeBelow.y + child.y) * sizeBelow.x + child.x;
        if (level == 1) {
            uint photon = cellPhotons[at];
            if (photon == 0u) continue;
            storedPhotons[place++] = StoredPhoton(photon - 1u, 0u, 0u);
            atomicAdd(counting.squares[0], 1u);
            continue;
        }
        uint own = storedOf[firstBelow + at];
        if (own == 0u) continue;
        // In any order: what is stored of it has its place already.
        uint listed = atomicAdd(walkLists[level - 1].count, 1u);
        squares[uint(firstBelow) + listed] = WalkSquare(uint(at), place);
        place += own;
    }
}
