// SPDX-License-Identifier: MIT
// shadow.rays: from every receiver pixel a ray back to each light, traced by the node that answers
// stage `trace` (K06, section 5, Figs. 11 and 12): through the layers, where what is hidden beyond
// the last one or off the screen throws no shadow, or exactly (trace.bvh). In: eye buffer and
// layered depth; out: visibility, 0 or 1 a pixel and light.
#include <fmt/format.h>

#include "framework/core/error.h"
#include "framework/transport/primitives.h"
#include "techniques/tracing/hit_testing.h"

namespace kaustik {
namespace {

// Photons that start at the receivers and fly to the light.
Photons aimAtLight(FrameBuilder& frame, const EyeBuffer& eye, int light) {
    return frame.pass<Photons>(
        "aim", "a ray from every receiver back to the light",
        [&](graph::PassSetup& setup, Photons& rays) {
            setup.sample("receiver", eye.receiver);
            setup.sample("receiverSurface", eye.receiverSurface);
            const std::string suffix = fmt::format("_shadow_{}", light);
            rays = Photons::create(setup, frame.width(), frame.height(), suffix, false);
            rays.ledger = setup.createBuffer<transport::LedgerEntry>("ledger" + suffix,
                                                                     transport::kLedgerEntryCount);
        },
        [light](const Photons& rays, gl::PassContext& context) {
            context.buffer(rays.ledger).clear();
            fillList(context, rays);
            context.fullscreen("shadow/rays_aim.frag")
                .set("lightIndex", light)
                .target(rays.position)
                .target(rays.direction)
                .target(rays.flux)
                .target(rays.origin)
                .draw();
        });
}

Shadows traceShadowRays(FrameBuilder& frame, const params::NoParams&, Geometry geometry,
                        EyeBuffer eye, LayeredDepth layers) {
    const int lights = frame.needs().lights;
    if (lights == 0) {
        frame.skip("shadow.rays", "the scene has no light");
        return {};
    }
    const TraceStage::Traits& tracer = frame.traits<TraceStage>();
    if (tracer.reach != TracerReach::eyeLayers && !tracer.bothSides) {
        throw ConfigError(
            "shadow.rays looks through the layers that the eye sees, and the chosen tracer does "
            "not: take shadow=map, trace=bvh, or a tracer of the layers, trace=hierarchical say.");
    }
    const FrameBuilder::PassScope within(frame, "shadow");
    Shadows shadows;
    for (int light = 0; light < lights; ++light) {
        const Hits hits =
            frame.run<TraceStage>(aimAtLight(frame, eye, light), Surfaces{geometry, eye, layers});
        shadows = frame.pass<Shadows>(
            "rays", "receivers that a ray cannot reach the light from lie in shadow",
            [&](graph::PassSetup& setup, Shadows& data) {
                hits.sample(setup);
                hits.incoming.sample(setup);
                if (light == 0) {
                    data.visibility = setup.create<VisibilityTexel>(
                        "shadow.visibility", frame.width(), frame.height(), lights);
                    setup.bypass(data.visibility, {1, 1, 1, 1});
                } else {
                    data.visibility = setup.write(shadows.visibility);
                    setup.bypass(data.visibility, shadows.visibility);
                }
            },
            [light](const Shadows& data, gl::PassContext& context) {
                context.fullscreen("shadow/rays.frag")
                    .set("lightIndex", light)
                    .target(data.visibility, light)
                    .draw();
            });
    }
    return shadows;
}

}  // namespace

void registerShadowRays(Registry& registry) {
    registry.node<ShadowStage>(
        "rays",
        {"Traces a ray from every receiver to the light, through the layers or exactly.",
         "K06, section 5",
         "A shadow is there or not, once a pixel. It takes a tracer of the eye's layers, of which "
         "what is off the screen or beyond the last one throws no shadow, or trace.bvh, which "
         "knows "
         "all, and refuses every other."},
        &traceShadowRays);
}

}  // namespace kaustik
