// SPDX-License-Identifier: MIT
// Pixels that span more of a map's texels than a gather looks up in them, as its shader counts them
// (include/maps/undersampled.glsl): said as a reached limit.
#pragma once

#include <optional>
#include <string>

#include "techniques/maps/counted_pixels.h"

namespace kaustik {

// For the pass that looks the map up: the lit pixels, and by which factor they span more.
inline CountedPixels countUndersampled(graph::PassSetup& setup, const std::string& suffix) {
    return CountedPixels::declare(setup, "UndersampledPixels", "gather.undersampled" + suffix);
}

// `node`: that has the parameter "max_samples" of this value.
inline void reportUndersampled(FrameBuilder& frame, const std::string& node, int maxSamples,
                               const CountedPixels& undersampled) {
    frame.reportLimit({node,
                       {undersampled.counted},
                       [=](const gl::Executor& executor) -> std::optional<ReachedLimit> {
                           const CountedPixels::Found found = undersampled.read(executor);
                           if (found.pixels == 0) return {};
                           return ReachedLimit{
                               .parameter = node + ".max_samples",
                               .unit = "looks",
                               .value = static_cast<double>(maxSamples),
                               .needed = maxSamples * found.largest,
                               .sentence = "the map holds what these pixels do not show",
                               .counted = "lit pixels span more texels than are looked up",
                               .count = found.pixels};
                       }});
}

}  // namespace kaustik
