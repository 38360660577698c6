// SPDX-License-Identifier: MIT
// shadow.map: the scene drawn from each light, six faces around a point light; shadow.lookup: each
// receiver's distance against the map's, comparisons averaged over three texels, or over the pixel
// where that is more than twice as wide. Depths in m; out: visibility.
#include "framework/pipeline/frame_builder.h"
#include "techniques/raster_views/shadow_maps.h"

namespace kaustik {
namespace {

Shadows lookUpShadowMaps(FrameBuilder& frame, const ShadowMapParams&, Geometry geometry,
                         EyeBuffer eye, LayeredDepth /*layers*/) {
    const int lights = frame.needs().lights;
    if (lights == 0) {
        frame.skip("shadow.map", "the scene has no light");
        return {};
    }
    const ShadowMaps& maps = shadowMaps(frame, geometry);
    return frame.pass<Shadows>(
        "shadow.lookup", "receivers may lie in shadow",
        [&](graph::PassSetup& setup, Shadows& data) {
            readShadowMaps(setup, maps);
            setup.sample("receiver", eye.receiver);
            setup.sample("receiverSurface", eye.receiverSurface);
            data.visibility = setup.create<VisibilityTexel>("shadow.visibility", frame.width(),
                                                            frame.height(), lights);
            setup.bypass(data.visibility, {1, 1, 1, 1});
        },
        [maps, lights](const Shadows& data, gl::PassContext& context) {
            for (int light = 0; light < lights; ++light) {
                gl::Command command = context.fullscreen("shadow/map.frag");
                bindShadowMaps(command, maps)
                    .set("lightIndex", light)
                    .target(data.visibility, light)
                    .draw();
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
