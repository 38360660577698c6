// SPDX-License-Identifier: MIT
// The mean of what the samples of a frame give (eye.samples): each is a frame of its own, whose
// rays go through another place in the pixels.
#pragma once

#include <fmt/format.h>

#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// The same texture, in which pass `compose.NAME` has put the mean over the samples so far, after
// the last one that of all; where a frame is one sample there is no such pass. Who is to see the
// sample alone reads the handle that is given.
template <class Texel>
[[nodiscard]] graph::Texture<Texel> meanOverSamples(FrameBuilder& frame, const std::string& name,
                                                    const graph::Texture<Texel>& ofSample) {
    const int samples = frame.inputs().samples;
    if (samples == 1 || !ofSample.valid()) return ofSample;
    struct Data {
        graph::Texture<Texel> soFar;
    };
    const int width = frame.width();
    const int height = frame.height();
    return frame
        .pass<Data>(
            "compose." + name, fmt::format("the picture is the mean of {} samples", samples),
            [&](graph::PassSetup& setup, Data& data) {
                const auto mean = setup.image(
                    "meanOfSamples",
                    setup.createPersistent<Texel>("compose." + name + "_mean", width, height));
                data.soFar = setup.image("ofSample", setup.write(ofSample));
                setup.bypass(mean, {0, 0, 0, 0});
                setup.bypass(data.soFar, ofSample);
            },
            [&inputs = frame.inputs(), width, height](const Data&, gl::PassContext& context) {
                context.compute("framework/sample_mean.comp")
                    .set("sampleNumber", inputs.sample)
                    .dispatchOver(width, 8, height, 8);
            })
        .soFar;
}

}  // namespace kaustik
