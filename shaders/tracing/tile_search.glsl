// SPDX-License-Identifier: MIT
// Which steps of its ray a tracer asks: all of them or, as TILE_SEARCH, those on one tile of the
// screen (K06, section 6). The tile next to it may ask a step at their border as well: both find
// the same there. What is found goes out with its step, so that of several tiles' hits the first
// along the ray is known, and with counts of the work.
#include "include/photons/traced_photon.glsl"

struct StepRange {
    int first;
    int end;
};

#ifdef TILE_SEARCH
uniform vec4 tileOwn;    // pixels: first, end
uniform vec4 tileShown;  // those whose layers are there: the tile's and a border around it
layout(r32ui) writeonly uniform uimage2D hitStep;  // of the hit + 1; 0: nothing was hit
layout(std430) buffer TileCounts {
    TileCount tileCounts[];
};

// Positions on the screen are off by less, px.
const float kTileMargin = 0.25;

uint askedSteps = 0u;
uint askedSquares = 0u;

void countSteps(uint count) {
    askedSteps += count;
}
void countSquares(uint count) {
    askedSquares += count;
}

// Cuts [first, end], in steps, to where a position that starts at `from` px and moves by `by` a step
// lies within two bounds.
void cutToBounds(float from, float by, float low, float high, inout float first, inout float end) {
    if (by == 0.0) {
        if (from < low || from > high) end = first - 1.0;
        return;
    }
    vec2 steps = (vec2(low, high) - from) / by;
    first = max(first, min(steps.x, steps.y));
    end = min(end, max(steps.x, steps.y));
}

// Steps whose middles lie on the tile. Those beyond the picture's edge count as on it.
StepRange stepsToAsk(RaySegment segment, int n) {
    vec2 perStep = (segment.farPixel - segment.nearPixel) / float(n);
    float first = 0.0;
    float end = float(n);
    for (int axis = 0; axis < 2; ++axis) {
        float low = tileOwn[axis] <= 0.0 ? -3e38 : tileOwn[axis] - kTileMargin;
        float high = tileOwn[axis + 2] >= view.sizePixels[axis] ? 3e38
                                                                : tileOwn[axis + 2] + kTileMargin;
        cutToBounds(segment.nearPixel[axis], perStep[axis], low, high, first, end);
    }
    if (first > end) return StepRange(0, 0);
    return StepRange(max(int(ceil(first - 0.5)), 0), min(int(floor(end - 0.5)) + 1, n));
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

void storeStep(ivec2 texel, Photon photon, FirstHit first, Hit hit) {
    imageStore(hitStep, texel, uvec4(first.hit.layer < 0 ? 0u : uint(first.step) + 1u));
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
StepRange stepsToAsk(RaySegment segment, int n) {
    return StepRange(0, n);
}
void storeStep(ivec2 texel, Photon photon, FirstHit first, Hit hit) {}
#endif
