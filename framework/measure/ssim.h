// SPDX-License-Identifier: MIT
// Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004, "Image quality assessment: from
// error visibility to structural similarity", Eq. 13): Gaussian window of 11x11 pixels with σ
// = 1.5, K1 = 0.01, K2 = 0.03, mean over all windows that lie inside the image.
//
// The paper is about pictures in a fixed range. Ours is made from linear luminance Y by one fixed
// transform: sRGB(clamp(Y / white, 0, 1)), with the dynamic range L = 1.
#pragma once

#include <optional>

#include "framework/measure/image_pair.h"
#include "framework/measure/plane.h"

namespace kaustik::measure {

inline constexpr int kSsimRadius = 5;  // pixels

// Luminance as it is shown where `white` (above 0, in the image's unit) is the display's 1.
[[nodiscard]] Plane<double> displayLuminance(const Image& rgb, double white);

// SSIM at each pixel of two planes with values in [0,1], in [-1,1]. Windows that reach past the
// border go on with the nearest pixel; they are not part of `ssim`.
[[nodiscard]] Plane<double> ssimMap(const Plane<double>& image, const Plane<double>& reference);

// The mean over the counted pixels whose window lies inside; 1 for equal images. Nothing where no
// window does.
[[nodiscard]] std::optional<double> ssim(const ImagePair& pair, double white);

}  // namespace kaustik::measure
