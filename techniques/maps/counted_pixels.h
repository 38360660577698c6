// SPDX-License-Identifier: MIT
// What a gather's shader counts: how many pixels have something, and the largest of it.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct CountedPixels {
    // x: how many; y: the largest, the bits of a float.
    graph::Buffer<glm::uvec2> counted;

    // For the pass whose shader has this `block`; none are counted where the pass is disabled.
    static CountedPixels declare(graph::PassSetup& setup, const std::string& block,
                                 const std::string& name) {
        CountedPixels made;
        made.counted = setup.storage(block, setup.createBuffer<glm::uvec2>(name, 1));
        setup.bypass(made.counted, {0, 0, 0, 0});
        return made;
    }
    void clear(gl::PassContext& context) const { context.buffer(counted).clear(); }

    struct Found {
        std::uint32_t pixels = 0;
        double largest = 0.0;
    };
    // Of a frame that is measured.
    [[nodiscard]] Found read(const gl::Executor& executor) const {
        const glm::uvec2 found = executor.buffer(counted).read<glm::uvec2>().front();
        return {found.x, static_cast<double>(std::bit_cast<float>(found.y))};
    }
};

}  // namespace kaustik
