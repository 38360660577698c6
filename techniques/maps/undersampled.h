// SPDX-License-Identifier: MIT
// Pixels that span more of a map's texels than a gather looks up in them, as its shader counts them
// (include/maps/undersampled.glsl): said as a reached limit.
#pragma once

#include <bit>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct Undersampled {
    // x: how many lit pixels; y: by which factor they span more at most, the bits of a float.
    graph::Buffer<glm::uvec2> pixels;

    // For the pass that looks the map up: declares "UndersampledPixels".
    static Undersampled count(graph::PassSetup& setup, const std::string& suffix) {
        Undersampled made;
        made.pixels = setup.storage("UndersampledPixels", setup.createBuffer<glm::uvec2>(
                                                              "gather.undersampled" + suffix, 1));
        setup.bypass(made.pixels, {0, 0, 0, 0});
        return made;
    }
    void clear(gl::PassContext& context) const { context.buffer(pixels).clear(); }
};

// `node`: that has the parameter "max_samples" of this value.
inline void reportUndersampled(FrameBuilder& frame, const std::string& node, int maxSamples,
                               const Undersampled& undersampled) {
    frame.reportLimit(
        {node,
         {undersampled.pixels},
         [=](const gl::Executor& executor) -> std::optional<ReachedLimit> {
             const glm::uvec2 found = executor.buffer(undersampled.pixels).read<glm::uvec2>()[0];
             if (found.x == 0) return {};
             return ReachedLimit{
                 .parameter = node + ".max_samples",
                 .unit = "looks",
                 .value = static_cast<double>(maxSamples),
                 .needed = maxSamples * static_cast<double>(std::bit_cast<float>(found.y)),
                 .sentence = "the map holds what these pixels do not show",
                 .counted = "lit pixels span more texels than are looked up",
                 .count = found.x};
         }});
}

}  // namespace kaustik
