// SPDX-License-Identifier: MIT
// Where rays go through a pixel of which there are several.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace kaustik::render {

// Px from the pixel's middle, within half a pixel: `count` points of a rank-1 lattice, one in each
// of as many columns and rows, symmetric about the middle, which is one of them where the count is
// odd; of 4 the rotated grid.
[[nodiscard]] std::vector<glm::vec2> samplesOfPixel(int count);

}  // namespace kaustik::render
