// SPDX-License-Identifier: MIT
// Display values in [0,1] as 8-bit integers.
#pragma once

#include <vector>

#include "framework/image/image.h"

namespace kaustik {

// The nearest of 0 to 255 for each value: clamped to [0,1], and 0 for what is not a number.
[[nodiscard]] std::vector<unsigned char> toEightBits(const Image& image);

}  // namespace kaustik
