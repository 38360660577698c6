// SPDX-License-Identifier: MIT
// Which steps of its ray a tracer asks: all of them or, as TILE_SEARCH, those on one tile of the
// screen (K06, section 6). The tile next to it may ask a step at their border as well: both find
// the same there.
#include "include/views/ray_segment.glsl"

struct StepRange {
    int first;
    int end;
};

#ifdef TILE_SEARCH
uniform vec4 tileOwn;  // pixels: first, end

// Positions on the screen are off by less, px.
const float kTileMargin = 0.25;

// Cuts [first, end], in steps, to where a position that starts at `from` px and moves by `by` a
// step lies within two bounds.
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
#else
StepRange stepsToAsk(RaySegment segment, int n) {
    return StepRange(0, n);
}
#endif
