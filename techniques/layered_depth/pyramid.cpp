// SPDX-License-Identifier: MIT
// layers.pyramid: over squares of 4, 16 and 64 pixels and for each layer a plane in 1/z and how far
// from it a ray may hit the layer; 1/z (of parallel rays: z) is linear on the screen where a
// surface is flat, so that the plane of a floor is exact at any size. Skipped where no tracer
// reads it. In: layered depth; out: planes, 1/m, the levels side by side in one array texture
// (shaders/layered_depth/pyramid_layout.glsl).
#include <algorithm>

#include "framework/pipeline/frame_builder.h"
#include "techniques/layered_depth/pyramid.h"

namespace kaustik {
namespace {

constexpr int kLevels = 3;

int squares(int pixels, int level) {
    const int side = 1 << (2 * level);
    return (pixels + side - 1) / side;
}

}  // namespace

LayeredDepth addPyramid(FrameBuilder& frame, const LayeredDepth& layers, const std::string& name) {
    const int w = layers.views->width();
    const int h = layers.views->height();
    return frame.pass<LayeredDepth>(
        "layers.pyramid", "the tracer skips what a ray cannot hit",
        [&](graph::PassSetup& setup, LayeredDepth& data) {
            data = layers;
            setup.image("layerDepths", layers.depth);
            data.pyramid = setup.image(
                "pyramid",
                setup.create<SquarePlane>(name + ".pyramid", squares(w, 1) + squares(w, 2),
                                          std::max(squares(h, 1), squares(h, 2) + squares(h, 3)),
                                          layers.views->layers(layers.layers)));
        },
        [w, h](const LayeredDepth& data, gl::PassContext& context) {
            const PixelRegion pixels = data.tile ? data.tile->shown : PixelRegion{{0, 0}, {w, h}};
            // Empty: a square's layers behind its last, and the corners next to the levels.
            context.texture(data.pyramid).clear({0, 0, 0, 0});
            for (int level = 1; level <= kLevels; ++level) {
                for (int face = 0; face < data.views->count(); ++face) {
                    gl::Command command = context.compute("layered_depth/pyramid.comp");
                    data.views->bindTo(command).set("layerCount", data.layers).set("level", level);
                    if (data.views->count() > 1) command.set("face", face);
                    const glm::ivec2 first = pixels.first >> (2 * level);
                    const glm::ivec2 end(squares(pixels.end.x, level),
                                         squares(pixels.end.y, level));
                    command.set("firstSquare", first)
                        .dispatchOver(end.x - first.x, 8, end.y - first.y, 8);
                }
            }
        });
}

}  // namespace kaustik
