// SPDX-License-Identifier: MIT
// A square of the eye's pixels, of reconstruct.triangles, as
// shaders/reconstruct/triangles_pixel_blocks.glsl has it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "framework/transport/patches.h"

namespace kaustik {

struct PixelBlock {
    glm::vec4 receiver;
    std::uint64_t sums[3];  // which shaders have as low and high words
    std::uint32_t unused[2];
};
static_assert(sizeof(PixelBlock) == 48);

}  // namespace kaustik
