// SPDX-License-Identifier: MIT
// Errors as colours. The map is a path through CIELAB whose lightness rises evenly from nearly
// black to nearly white, so that equal steps of error look equal, also to the colour-blind and in
// print without colour; its hue goes from violet over red and orange to yellow.
#pragma once

#include <array>

#include "framework/measure/image_pair.h"
#include "framework/measure/plane.h"

namespace kaustik::measure {

// Display-encoded sRGB in [0,1], for `t` from 0 (dark) to 1 (bright), clamped; 0 for NaN.
[[nodiscard]] std::array<float, 3> heatColor(double t);

// RGB, display-encoded, ready for writeImage: `errors` from 0 to `scale` (above 0, in the errors'
// unit) as heat colours; grey where the pair leaves a pixel out.
[[nodiscard]] Image heatMap(const ImagePair& pair, const Plane<float>& errors, double scale);

// |I - R|, the mean of the three channels.
[[nodiscard]] Plane<float> absoluteErrorPlane(const ImagePair& pair);

}  // namespace kaustik::measure
