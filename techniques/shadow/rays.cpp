// SPDX-License-Identifier: MIT
// shadow.rays: from every receiver pixel a ray back to each light, traced by the node that answers
// stage `trace` through the layers, where what is hidden beyond the last one or off the screen
// throws no shadow (K06, section 5, Figs. 11 and 12). In: eye buffer and layered depth; out:
// visibility, 0 or 1 a pixel and light.
#include <fmt/format.h>

#include "framework/core/error.h"
#include "framework/pipeline/frame_builder.h"
#include "framework/transport/primitives.h"

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
            rays = Photons::create(setup, frame.width(), frame.height(), suffix, {});
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

// Receivers that a ray cannot reach the light from.
Shadows storeShadows(FrameBuilder& frame, const Hits& hits, const Shadows& before, int light) {
    return frame.pass<Shadows>(
        "rays", "receivers that a ray cannot reach the light from lie in shadow",
        [&](graph::PassSetup& setup, Shadows& data) {
            hits.sample(setup);
            hits.incoming.sample(setup);
            if (light == 0) {
                data.visibility = setup.create<VisibilityTexel>(
                    "shadow.visibility", frame.width(), frame.height(), frame.needs().lights);
                setup.bypass(data.visibility, {1, 1, 1, 1});
            } else {
                data.visibility = setup.write(before.visibility);
                setup.bypass(data.visibility, before.visibility);
            }
        },
        [light](const Shadows& data, gl::PassContext& context) {
            context.fullscreen("shadow/rays.frag")
                .set("lightIndex", light)
                .target(data.visibility, light)
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
    if (frame.traits<TraceStage>().reach != TracerReach::eyeLayers) {
        throw ConfigError(
            "shadow.rays looks through the layers that the eye sees, and the chosen tracer does "
            "not: take shadow=map or shadow=bvh, or a tracer of the layers, trace=hierarchical "
            "say.");
    }
    const FrameBuilder::PassScope within(frame, "shadow");
    Shadows shadows;
    for (int light = 0; light < lights; ++light) {
        const Hits hits =
            frame.run<TraceStage>(aimAtLight(frame, eye, light), Surfaces{geometry, eye, layers});
        shadows = storeShadows(frame, hits, shadows, light);
    }
    return shadows;
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
