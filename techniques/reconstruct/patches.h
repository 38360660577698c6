// SPDX-License-Identifier: MIT
// What reconstruct.triangles hands from shader to shader and to the processor: patches, and squares
// of the eye's pixels. As shaders/reconstruct/triangles_wide.glsl and triangles_pixel_blocks.glsl
// have them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "techniques/reconstruct/triangles.h"

namespace kaustik {

struct PatchData {
    glm::vec4 corners[4];  // xyz, m; w: the density there
    glm::vec4 normal;      // xyz; w: the share of the flux in the first of its triangles
    glm::vec4 direction;   // xyz; w: its tolerance, m
    glm::vec4 flux;        // rgb, W; w: bits, those below
};
static_assert(sizeof(PatchData) == 112);
constexpr std::uint32_t kPatchIsJoined = 1;
constexpr std::uint32_t kPatchIsFromBehind = 2;
constexpr std::uint32_t kPatchIsAlone = 4;
constexpr std::uint32_t kPatchIsNone = 8;  // it is booked already

struct PixelBlock {
    glm::vec4 receiver;
    std::uint64_t sums[3];  // which shaders have as low and high words
    std::uint32_t unused[2];
};
static_assert(sizeof(PixelBlock) == 48);
constexpr int kPixelBlockSide = 4;  // px

}  // namespace kaustik
