// SPDX-License-Identifier: MIT
// reconstruct.triangles: how much of the light of each square between four photons of the grid comes
// where they are not joined. One thread an arrival.
#include "include/photons/arriving.glsl"
#include "light_cells/squares.glsl"
#include "reconstruct/triangles_arrivals.glsl"
#include "reconstruct/triangles_neighbours.glsl"

layout(std430) readonly buffer CellJoins {
    uint cellJoins[];
};
layout(std430) readonly buffer CellFlux {
    float cellFlux[];  // that was emitted, W
};
layout(std430) buffer PartedShares {
    uint partedShares[];
};

void main() {
    uint index;
    if (!arrivalOfThread(index)) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    PhotonOrigin origin = originAt(texel);
    float emitted = cellFlux[cellPlaceOf(origin, ivec2(0), 0u)];
    if (!(emitted > 0.0)) return;
    vec3 flux = wholeFlux(origin, texelFetch(hitFlux, texel, 0).rgb);
    float share = 0.25 * sumOfChannels(flux) / emitted;
    uvec2 extent = extentOf(origin);
    for (uint i = 0u; i < 4u; ++i) {
        uint lowerLeft = neighbourAt(origin, ivec2(i & 1u, i >> 1u) - 1);
        if (lowerLeft > 0u && cellJoins[lowerLeft - 1u] == 1u) continue;
        float part = share * areaOf(unpackedQuarter(extent, i));
        atomicAdd(partedShares[squareOf(origin, i)], uint(clamp(part, 0.0, 4.0) * kSquareParts));
    }
}
