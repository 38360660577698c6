// SPDX-License-Identifier: MIT
// Seeds that only the program can write: with fingerprints, or in its own order of bytes.
#pragma once

#include "framework/reference/pixel_sums.h"
#include "framework/reference/reference.h"

namespace kaustik::fuzz {

inline constexpr const char* kSumsKey = "key";

// Two batches of an image of 2x1 pixels.
[[nodiscard]] reference::PixelSums smallSums();
[[nodiscard]] reference::Reference smallReference();

}  // namespace kaustik::fuzz
