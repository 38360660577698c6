// SPDX-License-Identifier: MIT
// Image files as the measures take them: linear light, whatever they were made for.
#pragma once

#include <filesystem>
#include <string>

#include "framework/image/image.h"

namespace kaustik::measure {

// ".png" of "a/B.PNG".
[[nodiscard]] std::string lowerExtension(const std::filesystem::path& file);

// Whether the file holds a picture made for a display: not linear, and with 1 as its white.
[[nodiscard]] bool isDisplayPicture(const std::filesystem::path& file);

// The image of a file; one that was made for a display is decoded. Throws IoError.
[[nodiscard]] Image readLinear(const std::filesystem::path& file);

}  // namespace kaustik::measure
