// SPDX-License-Identifier: MIT
// What a tracer says next to hits where it asks the steps of one tile of the screen alone
// (TILE_SEARCH; K06, section 6): each hit's place in the order of the ray, so that of several
// tiles' hits the first is known, and counts of the work.
#include "include/photons/traced_photon.glsl"
#include "tracing/tile_steps.glsl"

#ifdef TILE_SEARCH
uniform vec4 tileShown;  // pixels whose layers are there, the tile's and a border: first, end
layout(rgba32ui) writeonly uniform uimage2D hitOrder;

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

// `order`: of a ray's hits the first has the least.
void storeOrder(ivec2 texel, Photon photon, FirstHit first, Hit hit, uint order) {
    uvec2 place = uvec2(0u);
    if (first.hit.layer >= 0) {
        place = uvec2(order, first.step);
        Photon seen = photonInView(photon);
        bool isBent = first.isExit || hit.fate == kFateSpecular;
        if (isBent && !isShownAround(seen.positionVs + first.hit.t * seen.directionVs))
            place.y |= kStrayed;
    }
    imageStore(hitOrder, texel, uvec4(place, askedSteps, askedSquares));
}
#else
void countSteps(uint count) {}
void countSquares(uint count) {}
void storeOrder(ivec2 texel, Photon photon, FirstHit first, Hit hit, uint order) {}
#endif
