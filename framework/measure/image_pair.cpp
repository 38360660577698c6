// SPDX-License-Identifier: MIT
#include "framework/measure/image_pair.h"

#include <fmt/format.h>

#include <algorithm>

#include "framework/core/error.h"
#include "framework/measure/finite.h"

namespace kaustik::measure {
namespace {

void requireFinite(const Image& image, const std::string& name) {
    if (const auto found = findNotFinite(image)) {
        throw IoError(fmt::format("{} has {}; nothing is measured.", name, describe(*found)));
    }
}

// `channel`: the only one to look at, or -1 for all.
void requireNotNegative(const Image& image, int onlyChannel, const std::string& name) {
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        const std::size_t channel = i % channels;
        if (onlyChannel >= 0 && channel != static_cast<std::size_t>(onlyChannel)) continue;
        if (image.values[i] >= 0.0f) continue;
        const std::size_t pixel = i / channels;
        const auto width = static_cast<std::size_t>(image.width);
        throw IoError(fmt::format("{} is negative ({}) at pixel ({}, {}), channel {}.", name,
                                  image.values[i], pixel % width, pixel / width, channel));
    }
}

void requireSize(const Image& image, const std::string& name, const PairInputs& inputs) {
    const Image& expected = inputs.image;
    if (image.width == expected.width && image.height == expected.height) return;
    throw ConfigError(fmt::format(
        "{} is {}x{} pixels but {} is {}x{}; only images of the same size can be compared.",
        inputs.imageName, expected.width, expected.height, name, image.width, image.height));
}

int colorChannels(const Image& image, const std::string& name) {
    if (image.channels == 1) return 1;
    if (image.channels == 3 || image.channels == 4) return 3;
    throw ConfigError(
        fmt::format("{} has {} channels; images with 1 (grey), 3 (RGB) or 4 (RGBA) "
                    "can be compared.",
                    name, image.channels));
}

void requireColorsAsImage(const Image& image, const std::string& name, const PairInputs& inputs) {
    const int expected = colorChannels(inputs.image, inputs.imageName);
    const int channels = colorChannels(image, name);
    if (channels == expected) return;
    throw ConfigError(
        fmt::format("{} has {} channel{} of colour but {} has {}; they do not show "
                    "the same quantity.",
                    inputs.imageName, expected, expected == 1 ? "" : "s", name, channels));
}

// Three channels, and 0 where `counts` is 0.
Image countedRgb(const Image& image, const std::vector<unsigned char>& counts) {
    Image rgb(image.width, image.height, 3);
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t pixel = 0; pixel < counts.size(); ++pixel) {
        if (counts[pixel] == 0) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            rgb.values[3 * pixel + c] = image.values[channels * pixel + (channels == 1 ? 0 : c)];
        }
    }
    return rgb;
}

}  // namespace

ImagePair::ImagePair(const PairInputs& inputs) {
    requireFinite(inputs.image, inputs.imageName);
    requireFinite(inputs.reference, inputs.referenceName);
    if (inputs.image.width < 1 || inputs.image.height < 1) {
        throw ConfigError(fmt::format("{} has no pixels.", inputs.imageName));
    }
    requireSize(inputs.reference, inputs.referenceName, inputs);
    requireColorsAsImage(inputs.reference, inputs.referenceName, inputs);

    const std::size_t pixels = static_cast<std::size_t>(inputs.image.width) *
                               static_cast<std::size_t>(inputs.image.height);
    counts_.assign(pixels, 1);
    if (const Image* mask = inputs.mask) {
        requireFinite(*mask, inputs.maskName);
        requireSize(*mask, inputs.maskName, inputs);
        const auto channels = static_cast<std::size_t>(mask->channels);
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            if (mask->values[channels * pixel] == 0.0f) counts_[pixel] = 0;
        }
    }
    countedPixels_ =
        pixels - static_cast<std::size_t>(std::count(counts_.begin(), counts_.end(), 0));
    if (countedPixels_ == 0) {
        throw ConfigError(fmt::format("{} is 0 in every pixel, which leaves nothing to compare.",
                                      inputs.maskName));
    }
    image_ = countedRgb(inputs.image, counts_);
    reference_ = countedRgb(inputs.reference, counts_);

    if (const Image* standardError = inputs.standardError) {
        requireFinite(*standardError, inputs.standardErrorName);
        requireSize(*standardError, inputs.standardErrorName, inputs);
        requireColorsAsImage(*standardError, inputs.standardErrorName, inputs);
        requireNotNegative(*standardError, -1, inputs.standardErrorName);
        standardError_ = countedRgb(*standardError, counts_);
    }
    areas_.assign(pixels, 1.0);
    if (const Image* area = inputs.area) {
        requireFinite(*area, inputs.areaName);
        requireSize(*area, inputs.areaName, inputs);
        requireNotNegative(*area, 0, inputs.areaName);
        const auto channels = static_cast<std::size_t>(area->channels);
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            areas_[pixel] = static_cast<double>(area->values[channels * pixel]);
        }
        hasArea_ = true;
    }
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        if (counts_[pixel] == 0) areas_[pixel] = 0.0;
    }
}

}  // namespace kaustik::measure
