// SPDX-License-Identifier: MIT
// From the coarsest squares of cells that one photon will do for: the middle photon of each carries
// all of its flux, as wide as the square, the others none. One thread a photon.
#include "light_cells/cell_lists.glsl"
#include "driver/hierarchical.glsl"
#include "include/photons/cells.glsl"
#include "include/photons/hits.glsl"
#include "include/photons/photon_thread.glsl"

layout(rgba32f) writeonly uniform image2D mergedFlux;
#ifdef PHOTON_BEAMS
layout(rgba32f) writeonly uniform image2D mergedPlace;
layout(rgba32f) writeonly uniform image2D mergedTurn;
#endif
uniform int levels;
uniform float tolerance;

int nodesOf(ivec2 size) { return size.x * size.y * cellLights.y << cellSplits; }

void main() {
    uint index = photonOfThread();
    if (index >= photons.count) return;
    ivec2 texel = ivec2(photonTexel(photons, index));
    vec4 flux = texelFetch(hitFlux, texel, 0);
    float width = 1.0;
    uint place = uint(flux.w) == kFateReceiver ? cellPlace(originAt(texel)) : kNoCell;
    if (place != kNoCell) {
        atomicAdd(counting.probes, 1u);
        int perGrid = cellGrid.x * cellGrid.y;
        int grid = int(place) / perGrid;
        ivec2 cell = ivec2(int(place) % cellGrid.x, int(place) % perGrid / cellGrid.x);
        int first = 0;
        ivec2 size = cellGrid;
        HierarchyNode found = kNoNode;
        for (int level = 1; level <= levels; ++level) {
            size = (size + 1) / 2;
            ivec2 here = cell >> level;
            HierarchyNode node = nodes[first + (grid * size.y + here.y) * size.x + here.x];
            // Squares around one that will do may do too: the coarsest counts.
            if (isOnePhoton(node, tolerance)) {
                found = node;
                width = float(1 << level);
            }
            first += nodesOf(size);
        }
        if (found.first != 0u) {
            bool isMiddle = found.middle == index + 1u;
            flux = isMiddle ? vec4(found.flux.rgb, flux.w) : vec4(vec3(0.0), float(kFateEnded));
            if (isMiddle) atomicAdd(counting.merged, 1u);
        }
        if (uint(flux.w) == kFateReceiver) atomicAdd(counting.emitted, 1u);
    }
    imageStore(mergedFlux, texel, flux);
#ifdef PHOTON_BEAMS
    imageStore(mergedPlace, texel, width * texelFetch(photonBeamPlace, texel, 0));
    imageStore(mergedTurn, texel, width * texelFetch(photonBeamTurn, texel, 0));
#endif
}
