// SPDX-License-Identifier: MIT
#include "framework/scene/texture.h"

#include <fmt/format.h>

#include <cmath>

#include "framework/core/error.h"

namespace kaustik::scene {
namespace {

float srgbToLinear(float value) {
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

}  // namespace

Image decodeTexture(const TextureImage& texture) {
    const Image source =
        texture.file.empty() ? decodeImage(texture.bytes, texture.name) : readImage(texture.file);
    Image linear(source.width, source.height, 3);
    for (int y = 0; y < source.height; ++y) {
        for (int x = 0; x < source.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const float value = source.at(x, y, source.channels >= 3 ? c : 0);
                if (!(value >= 0.0f && std::isfinite(value))) {
                    throw IoError(fmt::format(
                        "{} holds a value that is negative or no number, at pixel ({}, {}).",
                        texture.file.empty() ? texture.name : texture.file.string(), x, y));
                }
                linear.at(x, y, c) = texture.srgb ? srgbToLinear(value) : value;
            }
        }
    }
    return linear;
}

}  // namespace kaustik::scene
