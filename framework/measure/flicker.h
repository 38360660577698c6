// SPDX-License-Identifier: MIT
// How much an image changes from one moment to another, next to how much the truth does: a still
// picture may be right on the whole, and shimmer in motion. With I the image at both moments, R the
// reference with its standard error σ, and the mean over all counted pixels and their three
// channels, summed in double:
//   rms      = sqrt(mean((I₂ - I₁)²))
//   truthRms = sqrt(mean((R₂ - R₁)² - σ₁² - σ₂²)), 0 where the mean is below 0:
// what two noisy references differ by without any change is taken off its square.
#pragma once

#include <cstddef>

#include "framework/measure/image_pair.h"

namespace kaustik::measure {

struct Flicker {
    double rms = 0.0;  // the image's unit, as are the next two
    double truthRms = 0.0;
    // One standard deviation of truthRms, from what noise does to its square: pixels are
    // independent, channels vary together, as photons do. Where the truth hardly changes it is how
    // far above truthRms the change may lie.
    double truthStandardError = 0.0;
    std::size_t countedPixels = 0;

    // The change of the image less that of the truth. Above 0 the image changes more than it
    // should.
    [[nodiscard]] double difference() const { return rms - truthRms; }
};

// Both pairs have a standard error, are of the same size and leave out the same pixels. The noise
// of the references must be independent of each other: they are of different seeds.
[[nodiscard]] Flicker measureFlicker(const ImagePair& earlier, const ImagePair& later);

}  // namespace kaustik::measure
