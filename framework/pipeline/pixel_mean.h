// SPDX-License-Identifier: MIT
// The mean over a pixel's area of what is rendered with several samples a pixel (eye.samples).
#pragma once

#include <fmt/format.h>

#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// Pass `compose.NAME`: a texel a pixel of the picture, of a texture with a texel a sample. The
// texture itself where a pixel has one.
template <class Texel>
[[nodiscard]] graph::Texture<Texel> meanOverPixels(FrameBuilder& frame, const std::string& name,
                                                   const graph::Texture<Texel>& ofSamples) {
    const int side = frame.inputs().samplesPerSide;
    if (side == 1 || !ofSamples.valid()) return ofSamples;
    struct Data {
        graph::Texture<Texel> mean;
    };
    return frame
        .pass<Data>(
            "compose." + name, fmt::format("a pixel is the mean of {} samples", side * side),
            [&](graph::PassSetup& setup, Data& data) {
                setup.sample("ofSamples", ofSamples);
                data.mean = setup.create<Texel>("compose." + name, frame.width() / side,
                                                frame.height() / side);
            },
            [side](const Data& data, gl::PassContext& context) {
                context.fullscreen("framework/pixel_mean.frag")
                    .set("samplesPerSide", side)
                    .target(data.mean)
                    .draw();
            })
        .mean;
}

}  // namespace kaustik
