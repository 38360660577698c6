// SPDX-License-Identifier: MIT
// The end of a round of an adaptive traversal.
#include "light_cells/cell_lists.glsl"

layout(std430) writeonly buffer PhotonCellList {
    PhotonList photonCellList;
};
uniform uint maxTaken;
uniform uint maxPhotons;
uniform uint photonRow;

// With so many cells that wait, and photons.
void closeRound(uint waiting, uint photons) {
    counting.emitted += photons - counting.photons;
    counting.waiting = waiting;
    counting.photons = photons;
    photonCellList = photonListOf(photons, photonRow);
    // A round that would have to stop short waits for the next batch.
    uint wanted = min(waiting, maxTaken);
    counting.moreCells = (maxPhotons - photons) / 4u >= wanted ? wanted : 0u;
}
