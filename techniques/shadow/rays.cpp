// SPDX-License-Identifier: MIT
// shadow.rays: from every receiver pixel a ray back to each light, traced by the node that answers
// stage `trace` through the layers, where what is hidden beyond the last one or off the screen
// throws no shadow (K06, section 5, Figs. 11 and 12). In: eye buffer and layered depth; out:
// visibility, 0 or 1 a pixel and light.
#include "framework/core/error.h"
#include "techniques/shadow/rays_to_lights.h"

namespace kaustik {
namespace {

Shadows traceShadowRays(FrameBuilder& frame, const params::NoParams&, Geometry geometry,
                        EyeBuffer eye, LayeredDepth layers) {
    if (frame.needs().lights > 0 && frame.traits<TraceStage>().reach != TracerReach::eyeLayers) {
        throw ConfigError(
            "shadow.rays looks through the layers that the eye sees, and the chosen tracer does "
            "not: take shadow=map or shadow=bvh, or a tracer of the layers, trace=hierarchical "
            "say.");
    }
    return shadowsByRays(frame, "rays", geometry, eye, layers,
                         [&](Photons rays, Surfaces surfaces) {
                             return frame.run<TraceStage>(std::move(rays), std::move(surfaces));
                         });
}

}  // namespace

void registerShadowRays(Registry& registry) {
    registry.node<ShadowStage>(
        "rays",
        {"Traces a ray from every receiver to the light through the layers, as photons are traced.",
         "K06, section 5",
         "A shadow is there or not, once a pixel, and what is off the screen or beyond the last "
         "layer throws none. It takes a tracer of the eye's layers and refuses every other."},
        &traceShadowRays);
}

}  // namespace kaustik
