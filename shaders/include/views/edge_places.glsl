// SPDX-License-Identifier: MIT
// Where in a pixel at an edge the receivers are known that it shows
// (techniques/reconstruct/edge_samples.h), and where that is kept.
#include "framework/transport/edges.h"

// One in each of the pixel's quarters, from its corner: so that no two lie in one of four rows or
// columns, since an edge along these would show in all places of a side at once.
vec2 edgePlace(int sampled) {
    vec2 quarter = vec2(sampled & 1, sampled >> 1);
    return 0.125 + 0.5 * quarter + 0.25 * vec2(1.0 - quarter.y, quarter.x);
}

// `number`: of the pixel, from 0 on.
ivec2 edgeTexel(uint number, int sampled) {
    return ivec2(int(number) % kEdgePixelsOfRow * kEdgeSamples + sampled,
                 int(number) / kEdgePixelsOfRow);
}
