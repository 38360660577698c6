// SPDX-License-Identifier: MIT
// Depth peeling (K06, section 2.2), for whoever needs layers of some of the scene's surfaces.
#pragma once

#include <optional>
#include <string>

#include "framework/pipeline/frame_builder.h"
#include "framework/render/gpu_scene.h"

namespace kaustik {

// What a layered depth image is to hold, and the name that its resources begin with ("layers" gives
// "layers.depth").
struct LayersRequest {
    std::string name;
    render::DrawSet set = render::DrawSet::all;
    int layers = 8;
    bool reducesCounts = false;  // by a texture reduce instead of atomics
    // Whether somebody asks how many there are. Of one layer alone nothing else needs to know.
    bool countsFragments = true;
    std::string reader = "the tracer needs";  // that needs them, for people
    Views views = nullptr;                    // the eye's
    // Of the eye's view only what this tile of the screen shows; the rest stays empty.
    std::optional<ScreenTile> tile = {};
    [[nodiscard]] PixelRegion pixels(const render::RasterViews& of) const {
        return tile ? tile->shown : PixelRegion{{0, 0}, {of.width(), of.height()}};
    }
};
// Draws a command to the pixels that are asked for.
void drawTo(gl::Command& command, const LayersRequest& request);
// Adds the passes of a layered depth image without a pyramid; without statistics where there is one
// layer and nobody asks for them.
[[nodiscard]] LayeredDepth peel(FrameBuilder& frame, Geometry geometry,
                                const LayersRequest& request);

}  // namespace kaustik
