// SPDX-License-Identifier: MIT
// Where light comes from that a glossy receiver reflects, as gathers read it off a map: the mean
// direction of a texel's flux, and how far directions spread about it (shaders/include/maps/
// mean_direction.glsl). None is longer than 1 where a map's directions are those of its flux.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "techniques/maps/counted_pixels.h"

namespace kaustik {

// For the pass that reads them: what it counts of the mean directions that are longer than 1
// (include/maps/long_directions.glsl).
inline CountedPixels countLongDirections(graph::PassSetup& setup, const std::string& suffix) {
    return CountedPixels::declare(setup, "LongDirections", "gather.long_directions" + suffix);
}

// Says so of the gather's pass, in frames that are measured.
inline void warnOfDirections(FrameBuilder& frame, const std::string& node,
                             const CountedPixels& tooLong) {
    frame.warnIfFound(
        {node, {tooLong.counted}, [=](const gl::Executor& executor) -> std::optional<std::string> {
             const CountedPixels::Found found = tooLong.read(executor);
             if (found.pixels == 0) return {};
             return fmt::format(
                 "{} has found mean directions of light up to {:.4g} long, which none can be "
                 "beyond 1, "
                 "in {} pixels: the map's directions are not those of its flux, and what glossy "
                 "receivers reflect is wrong there.",
                 node, found.largest, found.pixels);
         }});
}

}  // namespace kaustik
