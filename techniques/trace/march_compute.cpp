// SPDX-License-Identifier: MIT
// trace.march_compute: trace.march with one compute thread a photon (tracing/ray_march.h).
#include "techniques/tracing/ray_march.h"

namespace kaustik {
namespace {

Hits traceMarchCompute(FrameBuilder& frame, const MarchParams& params, Photons photons,
                       Surfaces surfaces) {
    return marchRays(frame, {"march_compute", "trace/march_compute.comp"}, params, photons,
                     surfaces.layers);
}

}  // namespace

void registerTraceMarchCompute(Registry& registry) {
    registry.node<TraceStage>(
        "march_compute",
        {"As trace.march, in a compute shader, one thread a photon.",
         "K06, section 2.1, the comparison",
         "It finds what the layers of the view hold and nothing else: not what is outside of that "
         "view, edge-on, smaller than a pixel or beyond the last layer."},
        {.tiles = true}, &traceMarchCompute);
}

}  // namespace kaustik
