// SPDX-License-Identifier: MIT
// Where the receivers are kept that a pixel at an edge shows
// (techniques/reconstruct/edge_samples.h).
#include "framework/transport/edges.h"

// `number`: of the pixel, from 0 on.
ivec2 edgeTexel(uint number, int sampled) {
    return ivec2(int(number) % kEdgePixelsOfRow * kEdgeSamples + sampled,
                 int(number) / kEdgePixelsOfRow);
}
