// SPDX-License-Identifier: MIT
// Images by a module, in this process. What it reads comes from anyone, so that only a reader
// process calls those that read (`readImage`, `decodeImage` and `readLayers` have it do so). All
// throw IoError that begins with `name`, and says so where this build has no module.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "framework/image/image.h"
#include "framework/image/layered_image.h"

namespace kaustik {

[[nodiscard]] Image readByModule(const std::filesystem::path& path, const std::string& name);
[[nodiscard]] Image decodeByModule(std::string_view bytes, const std::string& name);

// The bytes of an OpenEXR file, 32-bit float.
[[nodiscard]] std::string encodeExr(const Image& image, const std::string& name);
// The bytes of a PNG file; `values` as of toEightBits(image).
[[nodiscard]] std::string encodePng(const Image& image, const std::vector<unsigned char>& values,
                                    const std::string& name);

[[nodiscard]] LayeredImage readLayersByModule(const std::filesystem::path& path,
                                              const std::string& name);
// The bytes of an OpenEXR file, 32-bit float.
[[nodiscard]] std::string encodeLayersByModule(const LayeredImage& image, const std::string& name);

}  // namespace kaustik
