// SPDX-License-Identifier: MIT
// What the judge does to whole pictures before it fits them.
#pragma once

#include <vector>

#include "framework/image/image.h"
#include "framework/judge/judge.h"

namespace kaustik::judge {

[[nodiscard]] bool isEmpty(const Image& image);
// The sum over all channels of the pixels where the mask is 1.
[[nodiscard]] double total(const Image& image, const Image& mask);
// How many pixels have a 1.
[[nodiscard]] double pixelCount(const Image& mask);
// Three channels of one or more; what is stored as it is.
[[nodiscard]] Image threeChannels(const Image& image);
// Linear light of stored values.
[[nodiscard]] Image decoded(const Image& image, Encoding encoding);
// Convolved with a Gaussian of that standard deviation, in pixels; edges repeat.
[[nodiscard]] Image blurred(const Image& image, double sigma);
// The variance of the same, where that of each pixel is given and pixels are independent.
[[nodiscard]] Image blurredVariance(const Image& variance, double sigma);
[[nodiscard]] Image sum(const std::vector<const Image*>& images);
// Half of the difference of the neighbours: the derivative by pixels.
[[nodiscard]] Image derivativeX(const Image& image);
[[nodiscard]] Image derivativeY(const Image& image);
// The derivative by the logarithm of a scale about the picture's middle.
[[nodiscard]] Image derivativeScale(const Image& image);

// The standard deviation of what differs from pixel to pixel in a residual, as a function of the
// light that is expected there: what a picture's own noise looks like. `expected` and `residual`
// have three channels. What the reference's error explains of it is taken off.
[[nodiscard]] Image noiseOf(const Image& residual, const Image& expected, const Image& known,
                            const Image& mask);

}  // namespace kaustik::judge
