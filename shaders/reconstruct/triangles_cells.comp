// SPDX-License-Identifier: MIT
// reconstruct.triangles: which photons of the list arrive, and from which cells. One thread a photon. Those
// that belong to other generators' maps too: where neighbours have left parts of one generator that
// has several reference points, what lies between them is joined and goes to one of the maps.
#include "include/photons/arriving.glsl"
#include "include/photons/cells.glsl"
#include "reconstruct/triangles_arrivals.glsl"

layout(std430) writeonly buffer CellPhotons {
    uint cellPhotons[];  // index + 1; 0 where none arrives
};

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    if (!hasArrivedFromAny(texel)) return;
    arrivedPhotons[atomicAdd(arrivals.count, 1u)] = index;
    uint place = cellPlace(originAt(texel));
    if (place != kNoCell) cellPhotons[place] = index + 1u;
}
