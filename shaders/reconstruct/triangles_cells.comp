// SPDX-License-Identifier: MIT
// reconstruct.triangles: which photon of the list arrives from each cell. One thread a photon.
#include "include/photons/arriving.glsl"
#include "include/photons/cells.glsl"

layout(std430) writeonly buffer CellPhotons {
    uint cellPhotons[];  // index + 1; 0 where none arrives
};

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    if (!hasArrived(texel)) return;
    uint place = cellPlace(originAt(texel), ivec2(0));
    if (place != kNoCell) cellPhotons[place] = index + 1u;
}
