// SPDX-License-Identifier: MIT
// FLIP, the difference that a viewer sees when flipping between two pictures (Andersson, Nilsson,
// Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating
// Images"). Both are filtered with the eye's contrast sensitivity in an opponent space (sec. 4.1),
// compared in Hunt-adjusted CIELAB with the HyAB distance (4.1), which differences in edges and
// points then raise (4.2, 4.3). In: linear Rec.709 in [0,1]. Out: 0 (equal) to 1 in each pixel.
#pragma once

#include <array>

#include "framework/measure/image_pair.h"
#include "framework/measure/plane.h"

namespace kaustik::measure {

// The paper's viewer: a 3840-pixel display of 0.7 m seen from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 67.0;

// Red, green and blue, linear, in [0,1].
using RgbPlanes = std::array<Plane<float>, 3>;

// `pixelsPerDegree` of visual angle, in [1, 1000]. The same when image and reference are swapped.
[[nodiscard]] Plane<float> flipMap(const RgbPlanes& image, const RgbPlanes& reference,
                                   double pixelsPerDegree = kFlipPixelsPerDegree);

// FLIP of the pictures in which the luminance `white` (above 0) is shown as the display's 1 and
// everything brighter is cut off: 1 for images that were made for a display.
[[nodiscard]] Plane<float> ldrFlipMap(const ImagePair& pair, double white,
                                      double pixelsPerDegree = kFlipPixelsPerDegree);

// The mean of a map over the counted pixels, in double.
[[nodiscard]] double pooledMean(const ImagePair& pair, const Plane<float>& map);

}  // namespace kaustik::measure
