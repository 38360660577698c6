// SPDX-License-Identifier: MIT
// How many cells a round takes: no more than a round may, and than there is room for photons of, four
// each. One thread.
#include "adaptive_caustic_map/cells.glsl"

layout(local_size_x = 1) in;

layout(std430) writeonly buffer TakenList {
    PhotonList takenList;
};
layout(std430) writeonly buffer ProbeList {
    PhotonList probeList;
};
uniform uint mostTaken;
uniform uint mostPhotons;
uniform uint takenRow;
uniform uint probeRow;

void main() {
    uint room = (mostPhotons - min(counting.photons, mostPhotons)) / 4u;
    uint taken = min(counting.waiting, min(mostTaken, room));
    counting.taken = taken;
    counting.waiting -= taken;
    counting.probes += 4u * taken;
    counting.rounds += 1u;
    takenList = photonListOf(taken, takenRow);
    probeList = photonListOf(4u * taken, probeRow);
}
