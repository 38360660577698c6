// SPDX-License-Identifier: MIT
// Images of many named channels, layers in one OpenEXR file: channels `TT.R`, `TT.G` and `TT.B` are
// the layer `TT`, as tev, HDRView and compositors group them. 32-bit float, linear.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "framework/image/image.h"

namespace kaustik {

// Rows from top to bottom, channels interleaved in the order of their names.
struct LayeredImage {
    struct Attribute {
        std::string name;
        std::string value;
    };
    int width = 0;
    int height = 0;
    std::vector<std::string> channels;  // full names, no two alike
    std::vector<float> values;
    std::vector<Attribute> attributes;  // text in the file's header

    // Adds the layer of an RGB image as PREFIX.R, PREFIX.G and PREFIX.B; R, G and B where the
    // prefix is "". All layers must be of one size.
    void addLayer(const std::string& prefix, const Image& image);
    [[nodiscard]] bool hasLayer(const std::string& prefix) const;
    // Throws IoError that names `name` where one of the three channels is missing.
    [[nodiscard]] Image layer(const std::string& prefix, const std::string& name) const;
    // "" where there is none.
    [[nodiscard]] std::string attribute(std::string_view name) const;
};

// Writes an .exr whole or not at all. Throws IoError naming the file, also where no module for
// images is there.
void writeLayers(const std::filesystem::path& path, const LayeredImage& image);

// Reads all channels of the first part of an .exr, and of its attributes those that are text, in a
// process of its own (framework/reading). Throws IoError that names the file and what is wrong.
[[nodiscard]] LayeredImage readLayers(const std::filesystem::path& path);

}  // namespace kaustik
