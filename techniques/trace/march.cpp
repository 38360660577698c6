// SPDX-License-Identifier: MIT
// trace.march: each photon's ray followed over the screen a pixel a step by a fragment, every layer
// looked up (K06, section 2.1; tracing/ray_march.h).
#include "techniques/tracing/ray_march.h"

namespace kaustik {
namespace {

Hits traceMarch(FrameBuilder& frame, const MarchParams& params, Photons photons,
                Surfaces surfaces) {
    return marchRays(frame, {"march", "trace/march.frag"}, params, photons, surfaces.layers);
}

}  // namespace

void registerTraceMarch(Registry& registry) {
    registry.node<TraceStage>(
        "march",
        {"Follows each photon's ray over the screen in a fragment shader, "
         "a pixel a step, to its first hit.",
         "K06, section 2.1, the comparison",
         "It finds what the layers of the view hold and nothing else: not what is outside of that "
         "view, edge-on, smaller than a pixel or beyond the last layer."},
        {.tiles = true}, &traceMarch);
}

}  // namespace kaustik
