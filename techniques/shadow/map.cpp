// SPDX-License-Identifier: MIT
// shadow.map: the scene drawn from each light, six faces around a point light; shadow.lookup: each
// receiver's distance against the map's, comparisons averaged over three texels, or over the pixel
// where that is more than twice as wide. Depths in m; out: visibility.
#include <fmt/format.h>

#include "framework/pipeline/frame_builder.h"
#include "techniques/raster_views/light_sight.h"

namespace kaustik {
namespace {

struct ShadowMapParams {
    int size = 2048;
    template <class R>
    void reflect(R& r) {
        r.field(size, "size",
                "Side of a light's shadow map; half of it where a light has a place, and with it "
                "six faces",
                "texels", params::range(16, 8192));
    }
};

// One face for a light with a direction, six around a point light.
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

Shadows lookUpShadowMaps(FrameBuilder& frame, const ShadowMapParams& params, Geometry geometry,
                         EyeBuffer eye, LayeredDepth /*layers*/) {
    std::vector<std::vector<LightSight>> byLight;
    std::vector<LightSight> all;
    for (const scene::Light& light : frame.scene().lights) {
        byLight.push_back(sightsOf(frame, light));
        all.insert(all.end(), byLight.back().begin(), byLight.back().end());
    }
    const int lights = static_cast<int>(byLight.size());
    // All maps lie in one array. Faces of 90 degrees see the scene larger than one map of all of
    // it.
    const bool hasCube = all.size() > byLight.size();
    const int side = hasCube ? params.size / 2 : params.size;
    if (lights == 0) {
        frame.skip("shadow.map", "the scene has no light");
        return {};
    }
    const LightDepths depths =
        drawLightDepths(frame,
                        {"shadow.map", fmt::format("{} light{}", lights, lights == 1 ? "" : "s"),
                         "shadow.maps", "shadow.depth_buffer"},
                        all, side, geometry);
    return frame.pass<Shadows>(
        "shadow.lookup", "receivers may lie in shadow",
        [&](graph::PassSetup& setup, Shadows& data) {
            setup.sample("shadowMap", depths.map);
            setup.sample("receiver", eye.receiver);
            setup.sample("receiverSurface", eye.receiverSurface);
            data.visibility = setup.create<VisibilityTexel>("shadow.visibility", frame.width(),
                                                            frame.height(), lights);
            setup.bypass(data.visibility, {1, 1, 1, 1});
        },
        [&inputs = frame.inputs(), byLight](const Shadows& data, gl::PassContext& context) {
            int firstLayer = 0;
            int layer = 0;  // of the visibility
            for (const std::vector<LightSight>& faces : byLight) {
                gl::Command command = context.fullscreen("shadow/map.frag");
                command.set("firstLayer", firstLayer)
                    .set("faceCount", static_cast<int>(faces.size()))
                    .set("projection", faces.front().view.projection());
                for (std::size_t face = 0; face < faces.size(); ++face) {
                    command.set(fmt::format("eyeToLight[{}]", face),
                                render::between(inputs.view, faces[face].view));
                }
                command.target(data.visibility, layer++).draw();
                firstLayer += static_cast<int>(faces.size());
            }
        });
}

}  // namespace

void registerShadowMap(Registry& registry) {
    registry.node<ShadowStage>(
        "map",
        {"Draws the scene from each light and compares distances.", "",
         "Lights have no size, so shadows are hard but for the width of the map's filter, and "
         "edges are as fine as its texels. Specular objects block direct light fully."},
        &lookUpShadowMaps);
}

}  // namespace kaustik
