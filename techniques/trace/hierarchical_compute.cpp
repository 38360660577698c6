// SPDX-License-Identifier: MIT
// trace.hierarchical_compute: trace.hierarchical with one compute thread a photon
// (tracing/ray_march.h).
#include "techniques/tracing/ray_march.h"

namespace kaustik {
namespace {

Hits traceHierarchicalCompute(FrameBuilder& frame, const MarchParams& params, Photons photons,
                              Surfaces surfaces) {
    return marchRays(frame,
                     {.node = "hierarchical_compute",
                      .shader = "trace/hierarchical_compute.comp",
                      .skipsSquares = true},
                     params, photons, surfaces.layers);
}

}  // namespace

void registerTraceHierarchicalCompute(Registry& registry) {
    registry.node<TraceStage>(
        "hierarchical_compute",
        {"As trace.hierarchical, in a compute shader, one thread a photon.", "",
         "It finds what the layers of the view hold and nothing else: not "
         "what is outside of that view, edge-on, smaller than a pixel or "
         "beyond the last layer. Its hits are those of trace.march."},
        {.tiles = true}, &traceHierarchicalCompute);
}

}  // namespace kaustik
