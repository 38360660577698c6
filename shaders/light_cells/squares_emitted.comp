// SPDX-License-Identifier: MIT
// What the light sends through each cell of a batch's grids, as far as its photon carries it. One
// thread a photon that was emitted.
#include "include/photons/neighbour_batch.glsl"
#include "include/photons/cells.glsl"
#include "include/photons/photon_thread.glsl"
#include "light_cells/cell_lists.glsl"

layout(std430) writeonly buffer CellFlux {
    float cellFlux[];  // W, of all channels
};

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    if (fateAt(texel) != kFateSpecular) return;
    Photon photon = photonAt(texel);
    PhotonOrigin origin = originAt(texel);
    float whole = isFromOtherBatch(origin) ? 1.0 / kNegligible : 1.0;
    cellFlux[cellPlaceOf(origin, ivec2(0), 0u)] =
        (photon.fluxWatts.r + photon.fluxWatts.g + photon.fluxWatts.b) * whole;
    atomicAdd(counting.probes, 1u);
}
