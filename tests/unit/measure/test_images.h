// SPDX-License-Identifier: MIT
// Small images for the tests of measures.
#pragma once

#include <array>
#include <random>

#include "framework/image/image.h"
#include "framework/measure/image_pair.h"

namespace kaustik::measure::test {

inline Image constantImage(int width, int height, const std::array<float, 3>& rgb) {
    Image image(width, height, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = rgb[i % 3];
    return image;
}

inline Image greyImage(int width, int height, float value) {
    return constantImage(width, height, {value, value, value});
}

// Each value even in [lowest, highest], and the same for a seed.
inline Image randomImage(int width, int height, unsigned seed, float lowest = 0.0f,
                         float highest = 1.0f) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> value(lowest, highest);
    Image image(width, height, 3);
    for (float& v : image.values)
        v = value(generator);
    return image;
}

inline Image scaled(Image image, float factor) {
    for (float& value : image.values)
        value *= factor;
    return image;
}

inline ImagePair pairOf(const Image& image, const Image& reference) {
    return ImagePair({.image = image, .reference = reference});
}

}  // namespace kaustik::measure::test
