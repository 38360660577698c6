// SPDX-License-Identifier: MIT
// How the values of an image become colours on the screen. Every texture has a look of its own,
// which is kept: what shows one well leaves another black.
#pragma once

#include <array>

namespace kaustik::gui {

// color: all channels of a colour or a vector at once; of others the first. luminance: of a colour,
// and the length of a vector.
enum class Channel : int { color, red, green, blue, alpha, luminance };

// Of false colours. symmetric: from -high over 0 in the middle to high.
enum class Scale : int { linear, logarithmic, symmetric };

// Flux of a photon is a billionth of a watt, irradiance in a focus a million W/m².
inline constexpr float kMaxStops = 60.0f;

struct Look {
    Channel channel = Channel::color;
    bool isExposureAutomatic = true;  // so that 99 % of what is not 0 is told apart
    float exposureStops = 0.0f;       // where it is not
    bool isFalseColor = false;
    Scale scale = Scale::linear;
    bool isRangeAutomatic = true;
    float low = 0.0f;  // where it is not
    float high = 1.0f;
    friend bool operator==(const Look&, const Look&) = default;
};

// Of false colours, display-encoded sRGB, for `t` from 0 to 1 along the scale. Both maps can be
// read by the colour-blind: from dark to bright in even steps of lightness, and for what is
// symmetric from blue over white to orange.
[[nodiscard]] std::array<float, 3> falseColor(Scale scale, double t);

// The place of a value on a scale from `low` to `high`, below 0 and above 1 beyond its ends. Of a
// logarithmic one both are above 0; a value that is not lies below it.
[[nodiscard]] double placeOn(Scale scale, double low, double high, double value);
// The value at a place from 0 to 1.
[[nodiscard]] double valueOn(Scale scale, double low, double high, double place);

}  // namespace kaustik::gui
