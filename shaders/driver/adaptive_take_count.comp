// SPDX-License-Identifier: MIT
// How many cells a round takes: no more than a round may, and than there is room for photons of, four
// each. One thread.
#include "light_cells/cell_lists.glsl"

layout(local_size_x = 1) in;

layout(std430) writeonly buffer TakenList {
    PhotonList takenList;
};
layout(std430) writeonly buffer ProbeList {
    PhotonList probeList;
};
uniform uint maxTaken;
uniform uint maxPhotons;
uniform uint takenRow;
uniform uint probeRow;

void main() {
    uint room = (maxPhotons - min(counting.photons, maxPhotons)) / 4u;
    // A traversal that has come to its end stays as it is.
    uint taken =
        counting.moreCells > 0u ? min(counting.waiting, min(maxTaken, room)) : 0u;
    counting.taken = taken;
    counting.waiting -= taken;
    counting.probes += 4u * taken;
    if (taken > 0u) counting.rounds += 1u;
    takenList = photonListOf(taken, takenRow);
    probeList = photonListOf(4u * taken, probeRow);
}
