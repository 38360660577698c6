// SPDX-License-Identifier: MIT
// Measures that look at one pixel at a time. With I the image, R the reference, and the mean over
// all counted pixels and their three channels, summed in double:
//   RMSE = sqrt(mean((I - R)²)), MAE = mean(|I - R|): in the image's unit;
//   relMSE = mean((I - R)² / (R² + epsilon)), epsilon in the unit squared;
//   energy ratio = sum(area I) / sum(area R), over pixels and channels.
#pragma once

#include "framework/measure/image_pair.h"
#include "framework/measure/reference_scale.h"

namespace kaustik::measure {

[[nodiscard]] double rootMeanSquareError(const ImagePair& pair);
[[nodiscard]] double meanAbsoluteError(const ImagePair& pair);

// Same for an image and a reference that are both scaled: epsilon follows the reference.
[[nodiscard]] inline double relMseEpsilon(const ReferenceScale& scale) {
    return 0.01 * scale.typical * scale.typical;
}
// `epsilon` above 0.
[[nodiscard]] double relativeMeanSquareError(const ImagePair& pair, double epsilon);

// Flux of all counted pixels and channels: W where areas are known, else a sum over pixels.
[[nodiscard]] double totalFlux(const ImagePair& pair, const Image& imageOfPair);
// `totalFlux` of the reference is not 0.
[[nodiscard]] double energyRatio(const ImagePair& pair);

// What a perfect image would be given on average, because the reference is itself an estimate with
// the standard error σ in each pixel, normally distributed and independent from pixel to pixel.
struct ReferenceNoise {
    double rmse = 0.0;         // sqrt(mean(σ²))
    double mae = 0.0;          // sqrt(2/π) mean(σ)
    double relMse = 0.0;       // mean(σ² / (R² + epsilon)); 0 where epsilon is
    double energyRatio = 0.0;  // one standard deviation; channels vary together, as photons do
};
// The pair has a standard error.
[[nodiscard]] ReferenceNoise referenceNoise(const ImagePair& pair, double epsilon);

// I - R, or |I - R|, in three channels; 0 where pixels are left out.
[[nodiscard]] Image signedError(const ImagePair& pair);
[[nodiscard]] Image absoluteError(const ImagePair& pair);

}  // namespace kaustik::measure
