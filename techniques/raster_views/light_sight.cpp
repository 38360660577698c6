// SPDX-License-Identifier: MIT
#include "techniques/raster_views/light_sight.h"

#include <fmt/format.h>

#include <algorithm>

namespace kaustik {

std::vector<LightSight> sightsOfSpecular(FrameBuilder& frame) {
    const scene::Scene& scene = frame.scene();
    const scene::Bounds target = scene::specularBounds(scene);
    std::vector<LightSight> sights;
    if (target.empty) return sights;
    for (const scene::Light& light : scene.lights) {
        if (light.band > 0) continue;
        const render::RasterView view = render::makeLightView(light, target, sceneBounds(scene));
        if (view.isClipped) {
            frame.warn(fmt::format(
                "Light '{}' sees the specular objects wider than 160 degrees; photons outside of "
                "that are not emitted, which emission_sampling of the ledger says.",
                light.name));
        }
        sights.push_back({view, &frame.keep(frame.gpuScene().makeInstances(view.worldToView))});
    }
    return sights;
}

LightDepths drawLightDepths(FrameBuilder& frame, const LightDepthsPass& pass,
                            const std::vector<LightSight>& sights, int side,
                            const Geometry& geometry) {
    return frame.pass<LightDepths>(
        pass.name, pass.reason,
        [&](graph::PassSetup& setup, LightDepths& data) {
            data.geometry = geometry;
            if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
            const int layers = std::max(static_cast<int>(sights.size()), 1);
            data.map = setup.create<LightDepth>(pass.map, side, side, layers);
            data.depth = setup.create<DepthBuffer>(pass.depthBuffer, side, side);
            setup.bypass(data.map, {0, 0, 0, 0});
            setup.bypass(data.depth, {0, 0, 0, 0});
        },
        [&inputs = frame.inputs(), sights](const LightDepths& data, gl::PassContext& context) {
            for (std::size_t layer = 0; layer < sights.size(); ++layer) {
                gl::Command command =
                    context.shaders({"raster_views/eye.vert", "raster_views/light_sight.frag"});
                command.set("projection", sights[layer].view.projection())
                    .target(data.map, static_cast<int>(layer))
                    .clear()
                    .depth(data.depth, gl::DepthTest::nearerReversed)
                    .clear();
                inputs.gpuScene.draw(command, context, data.geometry, *sights[layer].instances,
                                     render::DrawSet::all);
            }
        });
}

}  // namespace kaustik
