// SPDX-License-Identifier: MIT
// shadow.rays: from every receiver pixel a ray back to each light, traced through the layers by the
// node that answers stage `trace` (K06, section 5, Figs. 11 and 12). What is hidden behind the last
// layer or off the screen throws no shadow. In: eye buffer and layered depth; out: visibility, 0 or
// 1 a pixel and light.
#include <fmt/format.h>

#include "techniques/screen_space_photons/hit_testing.h"
#include "techniques/screen_space_photons/nodes.h"

namespace kaustik {
namespace {

// Photons that start at the receivers and fly to the light, with empty hits.
Hits aimAtLight(FrameBuilder& frame, const EyeBuffer& eye, int light) {
    struct Data {
        Hits rays;
        EyeBuffer eye;
    };
    const int w = frame.width();
    const int h = frame.height();
    return frame
        .pass<Data>(
            "aim", "a ray from every receiver back to the light",
            [&](graph::PassSetup& setup, Data& data) {
                data.eye = eye;
                setup.read(eye.receiver);
                setup.read(eye.receiverSurface);
                const auto name = [&](const char* what) {
                    return fmt::format("shadow.{}{}", what,
                                       light == 0 ? "" : fmt::format("_{}", light));
                };
                Hits& rays = data.rays;
                rays.position = setup.create<HitPosition>(name("hit_position"), w, h);
                rays.surface = setup.create<HitSurface>(name("hit_surface"), w, h);
                rays.flux = setup.create<HitFlux>(name("hit_flux"), w, h);
                Photons& photons = rays.incoming;
                photons.position = setup.create<PhotonPosition>(name("ray_position"), w, h);
                photons.direction = setup.create<PhotonDirection>(name("ray_direction"), w, h);
                photons.flux = setup.create<PhotonFlux>(name("ray_flux"), w, h);
                photons.ledger = setup.createBuffer<transport::LedgerEntry>(
                    name("ledger"), transport::kAccountCount);
                photons.width = w;
                photons.height = h;
            },
            [&inputs = frame.inputs(), light](const Data& data, gl::PassContext& context) {
                const Photons& photons = data.rays.incoming;
                context.buffer(photons.ledger).clear();
                for (const graph::ResourceRef& handle : std::initializer_list<graph::ResourceRef>{
                         data.rays.position, data.rays.surface, data.rays.flux}) {
                    context.texture(handle).clear({0, 0, 0, 0});
                }
                gl::Command command = context.fullscreen("screen_space_photons/shadow_aim.frag");
                inputs.bindView(command)
                    .storage("Lights", inputs.lights)
                    .storage("Materials", inputs.gpuScene.materials())
                    .texture("receiver", data.eye.receiver)
                    .texture("receiverSurface", data.eye.receiverSurface)
                    .set("lightIndex", light)
                    .target(photons.position)
                    .target(photons.direction)
                    .target(photons.flux)
                    .draw();
            })
        .rays;
}

}  // namespace

Shadows traceShadowRays(FrameBuilder& frame, const params::NoParams&, Geometry /*geometry*/,
                        EyeBuffer eye, LayeredDepth layers) {
    const int lights = frame.needs().lights;
    if (lights == 0) {
        frame.leaveOut("shadow.rays", "the scene has no light");
        return {};
    }
    struct Data {
        Hits rays;
        Shadows shadows;
    };
    const FrameBuilder::Within within(frame, "shadow");
    Shadows shadows;
    for (int light = 0; light < lights; ++light) {
        Hits rays = aimAtLight(frame, eye, light);
        rays = frame.run<TraceStage>(rays.incoming, layers, rays);
        shadows =
            frame
                .pass<Data>(
                    "rays", "receivers that a ray cannot reach the light from lie in shadow",
                    [&](graph::PassSetup& setup, Data& data) {
                        data.rays = rays;
                        setup.read(rays.position);
                        setup.read(rays.flux);
                        setup.read(rays.incoming.position);
                        setup.read(rays.incoming.flux);
                        data.shadows.visibility =
                            light == 0
                                ? setup.create<VisibilityTexel>("shadow.visibility", frame.width(),
                                                                frame.height(), lights)
                                : setup.write(shadows.visibility);
                        if (light == 0) {
                            setup.bypass(data.shadows.visibility, {1, 1, 1, 1});
                        } else {
                            setup.bypass(data.shadows.visibility, shadows.visibility);
                        }
                    },
                    [&inputs = frame.inputs(), light](const Data& data, gl::PassContext& context) {
                        context.fullscreen("screen_space_photons/shadow_rays.frag")
                            .storage("Lights", inputs.lights)
                            .texture("rayPosition", data.rays.incoming.position)
                            .texture("rayFlux", data.rays.incoming.flux)
                            .texture("hitPosition", data.rays.position)
                            .texture("hitFlux", data.rays.flux)
                            .set("lightIndex", light)
                            .target(data.shadows.visibility, light)
                            .draw();
                    })
                .shadows;
    }
    return shadows;
}

}  // namespace kaustik
