// SPDX-License-Identifier: MIT
#include "techniques/raster_views/shadow_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/scene/emitters.h"
#include "techniques/raster_views/shadow_view.h"

namespace kaustik {
namespace {

// One face for a light with a direction, six around one with a place.
std::vector<LightSight> sightsOf(FrameBuilder& frame, const scene::Light& light) {
    const scene::Bounds bounds = sceneBounds(frame.scene());
    const int faces = light.kind == scene::LightKind::directional ? 1 : 6;
    std::vector<LightSight> sights;
    for (int face = 0; face < faces; ++face) {
        const render::RasterView view = faces == 1 ? render::makeLightView(light, bounds, bounds)
                                                   : render::makeCubeFaceView(light.position, face);
        sights.push_back({view, &frame.keep(frame.gpuScene().makeInstances(view.worldToView))});
    }
    return sights;
}

ShadowMaps drawShadowMaps(FrameBuilder& frame, const Geometry& geometry) {
    std::vector<LightSight> sights;
    bool hasCube = false;
    for (const scene::Light& light : frame.scene().lights) {
        if (light.band > 0) continue;
        const std::vector<LightSight> own = sightsOf(frame, light);
        sights.insert(sights.end(), own.begin(), own.end());
        hasCube = hasCube || own.size() > 1;
    }
    std::vector<ShadowView> views;
    views.reserve(sights.size());
    for (const LightSight& sight : sights)
        views.push_back({render::between(frame.view(), sight.view), sight.view.projection()});
    // All maps lie in one array. Faces of 90 degrees see the scene larger than one map of all of
    // it.
    // The points of a light that has a size take no more memory than four lights together: what
    // each has of an edge is told by the mean of all.
    const double share = std::min(2.0 / std::sqrt(mostLightPoints(frame.scene())), 1.0);
    const int size =
        std::max(static_cast<int>(frame.params<ShadowMapParams>("shadow.map").size * share), 16);
    const int lights = frame.needs().lights;
    return {
        drawLightDepths(frame,
                        {"shadow.map", fmt::format("{} light{}", lights, lights == 1 ? "" : "s"),
                         "shadow.maps", "shadow.depth_buffer"},
                        sights, hasCube ? size / 2 : size, geometry),
        &frame.keep(gl::Buffer(views, "shadow.views"))};
}

}  // namespace

const ShadowMaps& shadowMaps(FrameBuilder& frame, const Geometry& geometry) {
    return *frame.once<ShadowMaps>("shadow.maps", [&] {
        return std::make_shared<ShadowMaps>(drawShadowMaps(frame, geometry));
    });
}

void readShadowMaps(graph::PassSetup& setup, const ShadowMaps& maps) {
    setup.sample("shadowMap", maps.depths.map);
}

gl::Command& bindShadowMaps(gl::Command& command, const ShadowMaps& maps) {
    return command.storage("ShadowViews", *maps.views);
}

}  // namespace kaustik
