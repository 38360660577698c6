// SPDX-License-Identifier: MIT
// Writes an image as it is on the screen: its values, and its colours.
#pragma once

#include <filesystem>
#include <vector>

#include "framework/gui/image_metadata.h"
#include "framework/image/image.h"

namespace kaustik::gui {

// `name`.exr with all values and `name`.png with the colours that were seen (RGB,
// display-encoded), both with the metadata; where no module for such files is there, .pfm and .ppm
// with the metadata in `name`.txt. Throws IoError.
std::vector<std::filesystem::path> writeShown(const std::filesystem::path& folder,
                                              const std::string& name, const Image& values,
                                              const Image& seen, const Metadata& metadata);

}  // namespace kaustik::gui
