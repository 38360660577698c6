// SPDX-License-Identifier: MIT
#include "framework/gui/look.h"

#include <algorithm>
#include <cmath>

#include "framework/measure/heat_map.h"

namespace kaustik::gui {
namespace {

// Lightness falls alike to both sides, hues are told apart with any of the common kinds of
// colour-blindness.
constexpr std::array<std::array<float, 3>, 5> kDiverging = {{{0.03f, 0.19f, 0.42f},
                                                             {0.26f, 0.58f, 0.76f},
                                                             {0.97f, 0.97f, 0.97f},
                                                             {0.99f, 0.55f, 0.24f},
                                                             {0.50f, 0.15f, 0.02f}}};

}  // namespace

std::array<float, 3> falseColor(Scale scale, double t) {
    if (scale != Scale::symmetric) return measure::heatColor(t);
    const double place =
        std::isnan(t) ? 0.0 : std::clamp(t, 0.0, 1.0) * double(kDiverging.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), kDiverging.size() - 2);
    const auto part = static_cast<float>(place - double(below));
    std::array<float, 3> color{};
    for (std::size_t c = 0; c < color.size(); ++c)
        color[c] = (1.0f - part) * kDiverging[below][c] + part * kDiverging[below + 1][c];
    return color;
}

double placeOn(Scale scale, double low, double high, double value) {
    switch (scale) {
        case Scale::logarithmic:
            if (!(value > 0.0)) return -1.0;
            return std::log(value / low) / std::log(high / low);
        case Scale::symmetric:
            return 0.5 + 0.5 * value / high;
        case Scale::linear:
            break;
    }
    return (value - low) / (high - low);
}

double valueOn(Scale scale, double low, double high, double place) {
    switch (scale) {
        case Scale::logarithmic:
            return low * std::pow(high / low, place);
        case Scale::symmetric:
            return (2.0 * place - 1.0) * high;
        case Scale::linear:
            break;
    }
    return low + place * (high - low);
}

}  // namespace kaustik::gui
