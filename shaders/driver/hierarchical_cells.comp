// SPDX-License-Identifier: MIT
// Which photon of a list that arrives stands for each cell. One thread a photon.
#include "include/photons/cells.glsl"
#include "include/photons/hits.glsl"
#include "include/photons/photon_thread.glsl"

layout(std430) writeonly buffer CellPhotons {
    uint cellPhotons[];  // + 1
};

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    if (uint(texelFetch(hitFlux, texel, 0).w) != kFateReceiver) return;
    uint place = cellPlace(originAt(texel));
    if (place != kNoCell) cellPhotons[place] = index + 1u;
}
