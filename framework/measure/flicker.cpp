// SPDX-License-Identifier: MIT
#include "framework/measure/flicker.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace kaustik::measure {
namespace {

double squared(double value) {
    return value * value;
}

// How much a value of two images differs, squared.
double squaredChange(const Image& from, const Image& to, std::size_t i) {
    return squared(static_cast<double>(to.values[i]) - static_cast<double>(from.values[i]));
}

}  // namespace

Flicker measureFlicker(const ImagePair& earlier, const ImagePair& later) {
    assert(earlier.hasStandardError() && later.hasStandardError());
    assert(earlier.pixelCount() == later.pixelCount());
    double sum = 0.0;
    double truthSum = 0.0;
    double truthVariance = 0.0;  // of that sum
    for (std::size_t pixel = 0; pixel < earlier.pixelCount(); ++pixel) {
        assert(earlier.counts(pixel) == later.counts(pixel));
        if (!earlier.counts(pixel)) continue;
        double deviation = 0.0;
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            sum += squaredChange(earlier.image(), later.image(), i);
            const double noise = squared(static_cast<double>(earlier.standardError().values[i])) +
                                 squared(static_cast<double>(later.standardError().values[i]));
            const double change = squaredChange(earlier.reference(), later.reference(), i) - noise;
            truthSum += change;
            // The variance of the square of a normal variable of this mean and variance.
            deviation += std::sqrt(2.0 * squared(noise) + 4.0 * noise * std::max(change, 0.0));
        }
        truthVariance += squared(deviation);
    }
    const double count = 3.0 * static_cast<double>(earlier.countedPixels());
    const double truthSquare = std::max(truthSum / count, 0.0);
    Flicker flicker;
    flicker.rms = std::sqrt(sum / count);
    flicker.truthRms = std::sqrt(truthSquare);
    flicker.truthStandardError =
        std::sqrt(truthSquare + std::sqrt(truthVariance) / count) - flicker.truthRms;
    flicker.countedPixels = earlier.countedPixels();
    return flicker;
}

}  // namespace kaustik::measure
