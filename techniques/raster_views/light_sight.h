// SPDX-License-Identifier: MIT
// What the lights see, for whoever emits photons or asks where light falls.
#pragma once

#include <string>
#include <vector>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct LightSight {
    render::RasterView view;
    const render::ViewInstances* instances = nullptr;
};
// The tightest view from each light that holds all that is specular; none where nothing is. Warns
// of lights that would have to see wider than a view can. All bands of a light have the same one:
// a photon's is that of `lightOfBand`.
[[nodiscard]] std::vector<LightSight> sightsOfSpecular(FrameBuilder& frame);

// Nearest surfaces as raster_views/light_sight.frag draws them. x: planar depth from the light, m,
// 0 none; yz: its growth a texel, as a share of it.
struct LightDepth {
    static constexpr Format format = Format::rgba32f;
};
struct LightDepths {
    graph::Texture<LightDepth> map;  // array, a layer a view
    graph::Texture<DepthBuffer> depth;
    Geometry geometry;
};
// What the pass that draws them is called, and says; and the names of its textures.
struct LightDepthsPass {
    std::string name;
    std::string reason;
    std::string map;
    std::string depthBuffer;
};
// Adds the pass that draws the whole scene in these views, `side` texels each; without any, one
// empty layer.
[[nodiscard]] LightDepths drawLightDepths(FrameBuilder& frame, const LightDepthsPass& pass,
                                          const std::vector<LightSight>& sights, int side,
                                          const Geometry& geometry);

}  // namespace kaustik
