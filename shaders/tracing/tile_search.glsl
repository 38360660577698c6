// SPDX-License-Identifier: MIT
// What a tracer says besides hits where it asks the steps of one tile of the screen alone
// (TILE_SEARCH; K06, section 6): each hit's place in the order of the ray, so that of several
// tiles' hits the first is known, and counts of the work.
#include "include/photons/traced_photon.glsl"
#include "tracing/tile_steps.glsl"

#ifdef TILE_SEARCH
uniform vec4 tileShown;  // pixels whose layers are there, the tile's and a border: first, end
layout(rg32ui) writeonly uniform uimage2D hitOrder;  // HitOrder
layout(std430) buffer TileCounts {
    TileCount tileCounts[];
};

uint askedSteps = 0u;
uint askedSquares = 0u;

void countSteps(uint count) {
    askedSteps += count;
}
void countSquares(uint count) {
    askedSquares += count;
}

// Whether the smooth surface around a hit is known: all pixels that smoothSurfaceAt asks are there.
bool isShownAround(vec3 pointVs) {
    ivec2 corner = ivec2(floor(pixelOf(pointVs) - 0.5));
    ivec2 last = ivec2(view.sizePixels.xy) - 1;
    ivec2 low = clamp(corner, ivec2(0), last);
    ivec2 high = clamp(corner + 1, ivec2(0), last);
    return all(greaterThanEqual(vec2(low), tileShown.xy)) &&
           all(lessThan(vec2(high), tileShown.zw));
}

void addCount(uint which, uint count) {
    uint before = atomicAdd(tileCounts[which].low, count);
    if (before + count < before) atomicAdd(tileCounts[which].high, 1u);
}

// `order`: which of a ray's hits is the first, the one of the least.
void storeOrder(ivec2 texel, Photon photon, FirstHit first, Hit hit, uint order) {
    imageStore(hitOrder, texel,
               first.hit.layer < 0 ? uvec4(0u) : uvec4(order, uint(first.step), 0u, 0u));
    Photon seen = photonInView(photon);
    bool isBent = first.hit.layer >= 0 && (first.isExit || hit.fate == kFateSpecular);
    if (isBent && !isShownAround(seen.positionVs + first.hit.t * seen.directionVs))
        addCount(kTileStrayed, 1u);
    if (askedSteps + askedSquares == 0u) return;
    addCount(kTilePhotons, 1u);
    addCount(kTileSteps, askedSteps);
    addCount(kTileSquares, askedSquares);
}
#else
void countSteps(uint count) {}
void countSquares(uint count) {}
void storeOrder(ivec2 texel, Photon photon, FirstHit first, Hit hit, uint order) {}
#endif
