// SPDX-License-Identifier: MIT
#include "framework/python/array.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/core/error.h"
#include "framework/measure/color.h"

namespace kaustik::python {

Array::Array(Image image)
    : shape{static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width),
            static_cast<std::size_t>(image.channels)},
      values(std::move(image.values)) {}

Image Array::layer(std::size_t index) const {
    if (index >= layers()) {
        throw ConfigError(fmt::format("There is no layer {}: this array has {}, counted from 0.",
                                      index, layers()));
    }
    const std::size_t size = height() * width() * channels();
    Image image;
    image.width = static_cast<int>(width());
    image.height = static_cast<int>(height());
    image.channels = static_cast<int>(channels());
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(index * size);
    image.values.assign(begin, begin + static_cast<std::ptrdiff_t>(size));
    return image;
}

Preview previewOf(const Array& array, std::size_t layer) {
    const Image source = array.layer(layer);
    const int shown = std::min(source.channels, 3);
    std::vector<float> positive;
    for (std::size_t i = 0; i < source.values.size(); ++i) {
        const float value = source.values[i];
        const bool counts = static_cast<int>(i) % source.channels < shown;
        if (counts && std::isfinite(value) && value > 0.0f) positive.push_back(value);
    }
    Preview preview{Image(source.width, source.height, 3), 1.0};
    if (!array.isForDisplay && !positive.empty()) {
        const auto nth = positive.begin() + static_cast<std::ptrdiff_t>(positive.size() * 99 / 100);
        std::nth_element(positive.begin(), nth, positive.end());
        preview.white = *nth;
    }
    for (int y = 0; y < source.height; ++y) {
        for (int x = 0; x < source.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const int from = shown == 1 ? 0 : c;
                const float value = from < shown ? source.at(x, y, from) : 0.0f;
                const double linear = std::isfinite(value) ? value / preview.white : 0.0;
                preview.image.at(x, y, c) =
                    static_cast<float>(array.isForDisplay ? value : measure::encodeSrgb(linear));
            }
        }
    }
    return preview;
}

}  // namespace kaustik::python
