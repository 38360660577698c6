// SPDX-License-Identifier: MIT
#include "techniques/shadow/rays_to_lights.h"

#include <fmt/format.h>

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

}  // namespace

Shadows shadowsByRays(FrameBuilder& frame, const std::string& name, const Geometry& geometry,
                      const EyeBuffer& eye, const LayeredDepth& layers, const RayTracing& trace) {
    const int lights = frame.needs().lights;
    if (lights == 0) {
        frame.skip("shadow." + name, "the scene has no light");
        return {};
    }
    const FrameBuilder::PassScope within(frame, "shadow");
    Shadows shadows;
    for (int light = 0; light < lights; ++light) {
        const Hits hits = trace(aimAtLight(frame, eye, light), Surfaces{geometry, eye, layers});
        shadows = frame.pass<Shadows>(
            name, "receivers that a ray cannot reach the light from lie in shadow",
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

}  // namespace kaustik
