// SPDX-License-Identifier: MIT
// shadow.map: the scene drawn from each light, six faces around a point light; shadow.lookup: each
// receiver's distance against the map's, the mean of 3x3 comparisons. Depths in m; out: visibility.
#include <fmt/format.h>

#include "framework/pipeline/frame_builder.h"
#include "techniques/shared/nodes.h"

namespace kaustik {
namespace {

struct ShadowMapParams {
    int size = 1024;
    template <class R>
    void reflect(R& r) {
        r.field(size, "size", "Side of a light's shadow map", "texels", params::range(16, 8192));
    }
};

// x: planar depth from the light, m, 0 none; yz: its growth a texel, as a share of it.
struct LightDepth {
    static constexpr Format format = Format::rgba32f;
};

struct ShadowView {
    glm::mat4 projection;
    std::vector<glm::mat4> eyeToLight;                    // by face
    std::vector<const render::ViewInstances*> instances;  // by face
    int firstLayer = 0;
};

// One face for a light with a direction, six around a point light.
std::vector<ShadowView> makeShadowViews(FrameBuilder& frame) {
    std::vector<ShadowView> views;
    const scene::Bounds bounds = sceneBounds(frame.scene());
    int layer = 0;
    for (const scene::Light& light : frame.scene().lights) {
        ShadowView shadow;
        shadow.firstLayer = layer;
        const int faces = light.kind == scene::LightKind::directional ? 1 : 6;
        for (int face = 0; face < faces; ++face) {
            const render::LightView view = faces == 1 ? render::makeLightView(light, bounds, bounds)
                                                      : render::makeCubeFaceView(light, face);
            shadow.projection = view.projection();
            shadow.eyeToLight.push_back(render::eyeToLight(view, frame.view()));
            shadow.instances.push_back(
                &frame.keep(frame.gpuScene().makeInstances(view.worldToLight)));
        }
        layer += faces;
        views.push_back(std::move(shadow));
    }
    return views;
}

struct ShadowMaps {
    graph::Texture<LightDepth> map;
    graph::Texture<DepthBuffer> depth;
    Geometry geometry;
};

ShadowMaps renderShadowMaps(FrameBuilder& frame, const ShadowMapParams& params,
                            const std::vector<ShadowView>& views, Geometry geometry) {
    const int layers = views.back().firstLayer + static_cast<int>(views.back().eyeToLight.size());
    return frame.pass<ShadowMaps>(
        "shadow.map", fmt::format("{} light{}", views.size(), views.size() == 1 ? "" : "s"),
        [&](graph::PassSetup& setup, ShadowMaps& data) {
            data.geometry = geometry;
            if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
            const int side = params.size;
            data.map = setup.create<LightDepth>("shadow.maps", side, side, layers);
            data.depth = setup.create<DepthBuffer>("shadow.depth_buffer", side, side);
            setup.bypass(data.map, {0, 0, 0, 0});
            setup.bypass(data.depth, {0, 0, 0, 0});
        },
        [&inputs = frame.inputs(), views](const ShadowMaps& data, gl::PassContext& context) {
            for (const ShadowView& view : views) {
                for (std::size_t face = 0; face < view.eyeToLight.size(); ++face) {
                    gl::Command command =
                        context.shaders({"shared/eye.vert", "shared/shadow.frag"});
                    command.set("projection", view.projection)
                        .target(data.map, view.firstLayer + static_cast<int>(face))
                        .clear()
                        .depth(data.depth, gl::DepthTest::nearerReversed)
                        .clear();
                    inputs.gpuScene.draw(command, context, data.geometry, *view.instances[face],
                                         render::DrawSet::all);
                }
            }
        });
}

Shadows lookUpShadowMaps(FrameBuilder& frame, const ShadowMapParams& params, Geometry geometry,
                         EyeBuffer eye, LayeredDepth /*layers*/) {
    const std::vector<ShadowView> views = makeShadowViews(frame);
    if (views.empty()) {
        frame.skip("shadow.map", "the scene has no light");
        return {};
    }
    const ShadowMaps maps = renderShadowMaps(frame, params, views, geometry);
    return frame.pass<Shadows>(
        "shadow.lookup", "receivers may lie in shadow",
        [&](graph::PassSetup& setup, Shadows& data) {
            setup.sample("shadowMap", maps.map);
            setup.sample("receiver", eye.receiver);
            setup.sample("receiverSurface", eye.receiverSurface);
            data.visibility = setup.create<VisibilityTexel>(
                "shadow.visibility", frame.width(), frame.height(), static_cast<int>(views.size()));
            setup.bypass(data.visibility, {1, 1, 1, 1});
        },
        [views](const Shadows& data, gl::PassContext& context) {
            for (std::size_t light = 0; light < views.size(); ++light) {
                gl::Command command = context.fullscreen("shared/shadow_lookup.frag");
                command.set("firstLayer", views[light].firstLayer)
                    .set("faceCount", static_cast<int>(views[light].eyeToLight.size()))
                    .set("projection", views[light].projection);
                for (std::size_t face = 0; face < views[light].eyeToLight.size(); ++face) {
                    command.set(fmt::format("eyeToLight[{}]", face), views[light].eyeToLight[face]);
                }
                command.target(data.visibility, static_cast<int>(light)).draw();
            }
        });
}

}  // namespace

void registerShadowMap(Registry& registry) {
    registry.node<ShadowStage>(
        "map", {"Draws the scene from each light and compares distances.", ""}, &lookUpShadowMaps);
}

}  // namespace kaustik
