// SPDX-License-Identifier: MIT
#include "framework/measure/color.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kaustik::measure {

Plane<double> luminancePlane(const Image& rgb) {
    Plane<double> plane(rgb.width, rgb.height);
    for (std::size_t pixel = 0; pixel < plane.values.size(); ++pixel) {
        const float* const color = rgb.values.data() + 3 * pixel;
        const double value = luminance(static_cast<double>(color[0]), static_cast<double>(color[1]),
                                       static_cast<double>(color[2]));
        plane.values[pixel] = std::max(value, 0.0);
    }
    return plane;
}

double encodeSrgb(double linear) {
    const double value = std::clamp(linear, 0.0, 1.0);
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

double decodeSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Image decodeSrgb(Image image) {
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        const bool isAlpha = channels % 2 == 0 && i % channels == channels - 1;
        if (isAlpha) continue;
        image.values[i] = static_cast<float>(decodeSrgb(static_cast<double>(image.values[i])));
    }
    return image;
}

}  // namespace kaustik::measure
