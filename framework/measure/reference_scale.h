// SPDX-License-Identifier: MIT
// How bright the reference is: what turns "dark" and "bright" into numbers for relMSE, SSIM and
// FLIP. A caustic layer is mostly black, so that medians and means over pixels say nothing; these
// are quantiles of the flux instead, and depend on the reference alone.
#pragma once

#include <vector>

#include "framework/measure/image_pair.h"

namespace kaustik::measure {

// Luminances, in the reference's unit; all 0 where the reference is black.
struct ReferenceScale {
    double brightest = 0.0;  // the largest
    double white = 0.0;      // pixels at least this bright hold 10 % of the flux,
    double typical = 0.0;    // 50 %,
    double faint = 0.0;      // 90 %

    [[nodiscard]] bool isBlack() const { return brightest <= 0.0; }
};

// Flux is luminance times the pixel's area.
[[nodiscard]] ReferenceScale referenceScale(const ImagePair& pair);

// By pixel: 1 where the reference is lit and not only noisy, which is where its luminance exceeds
// three times that of its standard error; above 0 where it has none. 0 for pixels that do not
// count.
[[nodiscard]] std::vector<unsigned char> litPixels(const ImagePair& pair);

}  // namespace kaustik::measure
