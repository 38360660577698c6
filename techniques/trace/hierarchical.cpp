// SPDX-License-Identifier: MIT
// trace.hierarchical: trace.march, but squares of pixels whose layers the ray cannot hit are
// skipped (tracing/ray_march.h, layered_depth/pyramid.cpp).
#include "techniques/tracing/ray_march.h"

namespace kaustik {
namespace {

Hits traceHierarchical(FrameBuilder& frame, const MarchParams& params, Photons photons,
                       Surfaces surfaces) {
    return marchRays(
        frame, {.node = "hierarchical", .shader = "trace/hierarchical.frag", .skipsSquares = true},
        params, photons, surfaces.layers);
}

}  // namespace

void registerTraceHierarchical(Registry& registry) {
    registry.node<TraceStage>("hierarchical",
                              {"Follows each photon's ray in a fragment shader and skips "
                               "squares of pixels whose layers it cannot hit.",
                               "",
                               "It finds what the layers of the view hold and nothing else: not "
                               "what is outside of that view, edge-on, smaller than a pixel or "
                               "beyond the last layer. Its hits are those of trace.march."},
                              {.tiles = true}, &traceHierarchical);
}

}  // namespace kaustik
