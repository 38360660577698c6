// SPDX-License-Identifier: MIT
#include "framework/measure/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "framework/measure/color.h"

namespace kaustik::measure {

std::string lowerExtension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool isDisplayPicture(const std::filesystem::path& file) {
    constexpr std::array kExtensions{".png", ".ppm", ".jpg", ".jpeg", ".bmp", ".gif", ".webp"};
    return std::find(kExtensions.begin(), kExtensions.end(), lowerExtension(file)) !=
           kExtensions.end();
}

Image readLinear(const std::filesystem::path& file) {
    Image image = readImage(file);
    return isDisplayPicture(file) ? decodeSrgb(std::move(image)) : image;
}

}  // namespace kaustik::measure
