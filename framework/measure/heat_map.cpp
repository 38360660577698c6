// SPDX-License-Identifier: MIT
#include "framework/measure/heat_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "framework/measure/color.h"
#include "framework/measure/pointwise.h"

namespace kaustik::measure {
namespace {

constexpr std::size_t kColors = 256;
constexpr float kMaskedGrey = 0.5f;  // grey, which is no heat colour

using Rgb = std::array<double, 3>;

Rgb linearRgbOfLab(double lightness, double chroma, double hueRadians) {
    const double y = (lightness + 16.0) / 116.0;
    const Rgb xyz{kWhiteXyz[0] * inverseLabCurve(y + chroma * std::cos(hueRadians) / 500.0),
                  kWhiteXyz[1] * inverseLabCurve(y),
                  kWhiteXyz[2] * inverseLabCurve(y - chroma * std::sin(hueRadians) / 200.0)};
    Rgb rgb{};
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column)
            rgb[row] += kRgbFromXyz[row][column] * xyz[column];
    }
    return rgb;
}

bool isShowable(const Rgb& rgb) {
    return std::all_of(rgb.begin(), rgb.end(), [](double v) { return v >= 0.0 && v <= 1.0; });
}

std::array<float, 3> makeColor(double t) {
    const double lightness = 3.0 + 93.0 * t;
    const double hue = (295.0 + 168.0 * t) * std::numbers::pi / 180.0;
    // As colourful as wished, or as a display can show at this lightness.
    double shown = 0.0;
    double tooMuch = 20.0 + 75.0 * std::sin(std::numbers::pi * std::sqrt(t));
    for (int step = 0; step < 30; ++step) {
        const double middle = 0.5 * (shown + tooMuch);
        (isShowable(linearRgbOfLab(lightness, middle, hue)) ? shown : tooMuch) = middle;
    }
    const Rgb rgb = linearRgbOfLab(lightness, shown, hue);
    return {static_cast<float>(encodeSrgb(rgb[0])), static_cast<float>(encodeSrgb(rgb[1])),
            static_cast<float>(encodeSrgb(rgb[2]))};
}

}  // namespace

std::array<float, 3> heatColor(double t) {
    static const std::vector<std::array<float, 3>> colors = [] {
        std::vector<std::array<float, 3>> made;
        for (std::size_t i = 0; i < kColors; ++i)
            made.push_back(makeColor(static_cast<double>(i) / (kColors - 1)));
        return made;
    }();
    const double inRange = std::isnan(t) ? 0.0 : std::clamp(t, 0.0, 1.0);
    return colors[static_cast<std::size_t>(std::lround(inRange * (kColors - 1)))];
}

Image heatMap(const ImagePair& pair, const Plane<float>& errors, double scale) {
    Image picture(errors.width, errors.height, 3);
    for (std::size_t pixel = 0; pixel < errors.values.size(); ++pixel) {
        std::array<float, 3> color{kMaskedGrey, kMaskedGrey, kMaskedGrey};
        if (pair.counts(pixel)) {
            color = heatColor(static_cast<double>(errors.values[pixel]) / scale);
        }
        std::copy(color.begin(), color.end(),
                  picture.values.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
    }
    return picture;
}

Plane<float> absoluteErrorPlane(const ImagePair& pair) {
    const Image errors = absoluteError(pair);
    Plane<float> plane(errors.width, errors.height);
    for (std::size_t i = 0; i < plane.values.size(); ++i) {
        const float* const error = errors.values.data() + 3 * i;
        plane.values[i] = (error[0] + error[1] + error[2]) / 3.0f;
    }
    return plane;
}

}  // namespace kaustik::measure
