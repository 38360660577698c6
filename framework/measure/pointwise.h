// SPDX-License-Identifier: MIT
// Measures that look at one pixel at a time. With I the image, R the reference, and the mean over
// all counted pixels and their three channels, summed in double:
//   RMSE = sqrt(mean((I - R)²)), MAE = mean(|I - R|): in the image's unit;
//   relMSE = mean((I - R)² / (R² + epsilon)), epsilon in the unit squared;
//   energy ratio = sum(area I) / sum(area R), over pixels and channels;
//   SMAPE = mean(|I - R| / (|I| + |R|)) over lit pixels (litPixels) and their channels: 0 to 1.
// What each sees: RMSE and MAE the brightest light; relMSE all that is not much darker than where
// half of the flux is, and nothing of what its epsilon hides: of light a hundred times darker all
// may be missing. The energy ratio sees that weak light is missing, unless as much is too much
// elsewhere, and not where. SMAPE counts every lit pixel alike, however dark: missing light is 1 in
// each, twice too much 1/3. It does not see light where the reference is dark, nor how bright what
// is wrong is. relMSE with an epsilon as small as weak light would not do: bright light that is off
// by a pixel, next to the dark, is then all that it is made of (results/accuracy.md, "Weak light").
#pragma once

#include <vector>

#include "framework/measure/image_pair.h"
#include "framework/measure/reference_scale.h"

namespace kaustik::measure {

[[nodiscard]] double rootMeanSquareError(const ImagePair& pair);
[[nodiscard]] double meanAbsoluteError(const ImagePair& pair);

// The epsilon for an image and a reference that are both scaled: it follows the reference.
[[nodiscard]] inline double relMseEpsilon(const ReferenceScale& scale) {
    return 0.01 * scale.typical * scale.typical;
}
// `epsilon` above 0.
[[nodiscard]] double relativeMeanSquareError(const ImagePair& pair, double epsilon);

// Pixels with `lit` 1 alone, of which there is one at least. Where image and reference are both 0
// in a channel nothing is wrong.
[[nodiscard]] double symmetricRelativeError(const ImagePair& pair,
                                            const std::vector<unsigned char>& lit);

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
    double smape = 0.0;        // sqrt(2/π) mean(σ / 2R) over lit pixels, no more than 1 in each
    double energyRatio = 0.0;  // one standard deviation; channels vary together, as photons do
};
// The pair has a standard error; `lit` as litPixels gives it.
[[nodiscard]] ReferenceNoise referenceNoise(const ImagePair& pair, double epsilon,
                                            const std::vector<unsigned char>& lit);

// I - R, or |I - R|, in three channels; 0 where pixels are left out.
[[nodiscard]] Image signedError(const ImagePair& pair);
[[nodiscard]] Image absoluteError(const ImagePair& pair);

}  // namespace kaustik::measure
