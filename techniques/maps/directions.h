// SPDX-License-Identifier: MIT
// Where light comes from that a glossy receiver reflects, as gathers read it off a map: the mean
// direction of a texel's flux, and how far directions spread about it (shaders/include/maps/
// mean_direction.glsl). None is longer than 1 where a map's directions are those of its flux.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// What a gather counts of the mean directions that are longer than 1.
struct Directions {
    // x: how many pixels; y: the longest, the bits of a float.
    graph::Buffer<glm::uvec2> tooLong;

    // For the pass that reads them: declares "LongDirections".
    static Directions count(graph::PassSetup& setup, const std::string& suffix) {
        Directions made;
        made.tooLong = setup.storage(
            "LongDirections", setup.createBuffer<glm::uvec2>("gather.long_directions" + suffix, 1));
        setup.bypass(made.tooLong, {0, 0, 0, 0});
        return made;
    }
    void clear(gl::PassContext& context) const { context.buffer(tooLong).clear(); }
};

// Says so of the gather's pass, in frames that are measured.
inline void warnOfDirections(FrameBuilder& frame, const std::string& node,
                             const Directions& directions) {
    frame.warnIfFound(
        {node,
         {directions.tooLong},
         [=](const gl::Executor& executor) -> std::optional<std::string> {
             const glm::uvec2 found =
                 executor.buffer(directions.tooLong).read<glm::uvec2>().front();
             if (found.x == 0) return {};
             return fmt::format(
                 "{} has found mean directions of light up to {:.4g} long, which none can be "
                 "beyond 1, "
                 "in {} pixels: the map's directions are not those of its flux, and what glossy "
                 "receivers reflect is wrong there.",
                 node, static_cast<double>(std::bit_cast<float>(found.y)), found.x);
         }});
}

}  // namespace kaustik
