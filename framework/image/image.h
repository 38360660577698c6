// SPDX-License-Identifier: MIT
// Images in memory and in files. Everything outside this folder sees only this header; OpenImageIO,
// or OpenEXR and libpng where that is not to be had, sits in a module that is loaded when the first
// EXR, PNG or JPEG is read or written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace kaustik {

// Rows from top to bottom, channels interleaved, 32-bit float, linear unless said otherwise.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;  // 1 to 4
    std::vector<float> values;

    Image() = default;
    Image(int w, int h, int c);
    [[nodiscard]] float& at(int x, int y, int c);
    [[nodiscard]] float at(int x, int y, int c) const;
};

// True when files such as .exr and .png can be read and written: a module for them is there.
[[nodiscard]] bool hasImageModule();

// What can be read, for people.
[[nodiscard]] std::string imageFormats();

// ".exr" and ".png" with a module, ".pfm" and ".ppm" without.
[[nodiscard]] std::string floatImageExtension();
[[nodiscard]] std::string displayImageExtension();

// Reads by extension: .pfm here, everything else through the module, values as stored
// (8-bit as [0,1]). Throws IoError that names the file and what is wrong with it.
[[nodiscard]] Image readImage(const std::filesystem::path& path);

// Decodes an image file held in memory (embedded glTF textures). `name` is for messages.
[[nodiscard]] Image decodeImage(std::string_view bytes, const std::string& name);

// Writes whole or not at all, by extension: .pfm (1 or 3 channels) and .exr as 32-bit float,
// .ppm and .png as 8 bits (values in [0,1], clamped; already display-encoded).
// Throws IoError naming the file.
void writeImage(const std::filesystem::path& path, const Image& image);

}  // namespace kaustik
