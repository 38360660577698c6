// SPDX-License-Identifier: MIT
// The walk begins with those squares at the top of the mip map, one of each light and branch, that
// hold a photon at all; how many photons will be stored is known there. One thread.
#include "driver/hierarchical_walk.glsl"

layout(local_size_x = 1) in;

layout(std430) writeonly buffer StoredList {
    PhotonList storedList;
};
uniform int topSquares;
uniform int top;         // level
uniform int first;       // node of it
uniform uint rowLength;  // of the list that is stored, texels

void main() {
    uint listed = 0u;
    uint stored = 0u;
    for (int square = 0; square < topSquares; ++square) {
        uint own = storedOf[first + square];
        if (own == 0u) continue;
        squares[uint(first) + listed++] = WalkSquare(uint(square), stored);
        stored += own;
    }
    for (int level = 1; level < top; ++level) walkLists[level] = photonListOf(0u, 1u);
    walkLists[top] = photonListOf(listed, 1u);
    storedList = photonListOf(stored, rowLength);
}
