// SPDX-License-Identifier: MIT
// Where an image is wrong by more than the noise of its reference explains. With I the image's and
// R the reference's luminance and σ the standard error of R, as if its channels varied together, as
// photons do:
//   z = (I - R) / σ,   significant where |z| > 3.29, which noise alone exceeds in a pixel of 1000.
// A pixel that no photon of the reference has reached has no σ of its own: it is given the median
// of the others'. With few photons a pixel noise is skewed, and a few more than by chance are too
// bright. What the image itself has of noise, as that of where its photons start, counts as its
// error: nothing says what part of it that is.
#pragma once

#include <cstddef>

#include "framework/measure/image_pair.h"

namespace kaustik::measure {

struct Bias {
    static constexpr double kSignificant = 3.29;
    static constexpr double kByChance = 0.001;  // of the pixels
    std::size_t judgedPixels = 0;  // all that count; none where the reference has no noise
    double tooBright = 0.0;        // shares of the judged pixels; 0 where none is
    double tooDark = 0.0;
};

// The pair has a standard error.
[[nodiscard]] Bias findBias(const ImagePair& pair);

// RGB, display-encoded, ready for writeImage: too bright orange, too dark blue, from dark at
// kSignificant to bright at ten times that; nearly black where nothing is significant; grey where
// nothing is judged.
[[nodiscard]] Image biasPicture(const ImagePair& pair);

}  // namespace kaustik::measure
