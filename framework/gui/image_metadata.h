// SPDX-License-Identifier: MIT
// What a file of an image says of itself: text in the bytes of a PNG (iTXt chunks) or an OpenEXR
// file (string attributes), which any viewer shows.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace kaustik::gui {

using Metadata = std::vector<std::pair<std::string, std::string>>;  // keyword, UTF-8

// The same file with the texts; pixels are as they were. Throws IoError where it is no such file.
[[nodiscard]] std::string withPngText(const std::string& png, const Metadata& metadata);
// Of a file of one part. Keywords have "kaustik." before them.
[[nodiscard]] std::string withExrAttributes(const std::string& exr, const Metadata& metadata);

}  // namespace kaustik::gui
