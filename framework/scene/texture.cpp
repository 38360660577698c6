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

// Of all texels of a normal map so many point out of the surface, and so many are about as long as
// a normal: compression and filtering shorten some.
constexpr double kOutwards = 0.95;
constexpr double kUnit = 0.5;

std::string nameOf(const TextureImage& texture) {
    return texture.file.empty() ? texture.name : texture.file.string();
}

// Colours to vectors.
void becomeVectors(Image& image, const TextureImage& texture) {
    double outwards = 0.0;
    double unit = 0.0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            double length2 = 0.0;
            for (int c = 0; c < 3; ++c) {
                float& value = image.at(x, y, c);
                value = 2.0f * value - 1.0f;
                length2 += static_cast<double>(value) * static_cast<double>(value);
            }
            outwards += image.at(x, y, 2) > 0.0f ? 1.0 : 0.0;
            unit += std::abs(std::sqrt(length2) - 1.0) < 0.15 ? 1.0 : 0.0;
        }
    }
    const double texels = static_cast<double>(image.width) * static_cast<double>(image.height);
    if (outwards >= kOutwards * texels && unit >= kUnit * texels) return;
    throw IoError(fmt::format(
        "{} is no normal map: {:.0f}% of its texels point out of the surface (blue above 0.5) and "
        "{:.0f}% are about of length 1.",
        nameOf(texture), 100.0 * outwards / texels, 100.0 * unit / texels));
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
                        nameOf(texture), x, y));
                }
                linear.at(x, y, c) = texture.srgb ? srgbToLinear(value) : value;
            }
        }
    }
    if (texture.isNormalMap) becomeVectors(linear, texture);
    return linear;
}

}  // namespace kaustik::scene
