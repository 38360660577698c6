// SPDX-License-Identifier: MIT
#include "framework/measure/pointwise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace kaustik::measure {
namespace {

// The mean of term(first, second) over counted pixels and channels.
template <class Term>
double mean(const ImagePair& pair, const Image& first, const Image& second, const Term& term) {
    double sum = 0.0;
    for (std::size_t pixel = 0; pixel < pair.pixelCount(); ++pixel) {
        if (!pair.counts(pixel)) continue;
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            sum +=
                term(static_cast<double>(first.values[i]), static_cast<double>(second.values[i]));
        }
    }
    return sum / (3.0 * static_cast<double>(pair.countedPixels()));
}

// The same over lit pixels.
template <class Term>
double meanOfLit(const std::vector<unsigned char>& lit, const Image& first, const Image& second,
                 const Term& term) {
    double sum = 0.0;
    std::size_t values = 0;
    for (std::size_t pixel = 0; pixel < lit.size(); ++pixel) {
        if (lit[pixel] == 0) continue;
        values += 3;
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            sum +=
                term(static_cast<double>(first.values[i]), static_cast<double>(second.values[i]));
        }
    }
    return values > 0 ? sum / static_cast<double>(values) : 0.0;
}

double squared(double value) {
    return value * value;
}

}  // namespace

double rootMeanSquareError(const ImagePair& pair) {
    return std::sqrt(mean(pair, pair.image(), pair.reference(),
                          [](double i, double r) { return squared(i - r); }));
}

double meanAbsoluteError(const ImagePair& pair) {
    return mean(pair, pair.image(), pair.reference(),
                [](double i, double r) { return std::abs(i - r); });
}

double relativeMeanSquareError(const ImagePair& pair, double epsilon) {
    assert(epsilon > 0.0);
    return mean(pair, pair.image(), pair.reference(),
                [epsilon](double i, double r) { return squared(i - r) / (squared(r) + epsilon); });
}

double symmetricRelativeError(const ImagePair& pair, const std::vector<unsigned char>& lit) {
    return meanOfLit(lit, pair.image(), pair.reference(), [](double i, double r) {
        const double sum = std::abs(i) + std::abs(r);
        return sum > 0.0 ? std::abs(i - r) / sum : 0.0;
    });
}

double totalFlux(const ImagePair& pair, const Image& imageOfPair) {
    double sum = 0.0;
    for (std::size_t pixel = 0; pixel < pair.pixelCount(); ++pixel) {
        const float* const color = imageOfPair.values.data() + 3 * pixel;
        sum += pair.area(pixel) * (static_cast<double>(color[0]) + static_cast<double>(color[1]) +
                                   static_cast<double>(color[2]));
    }
    return sum;
}

double energyRatio(const ImagePair& pair) {
    return totalFlux(pair, pair.image()) / totalFlux(pair, pair.reference());
}

ReferenceNoise referenceNoise(const ImagePair& pair, double epsilon,
                              const std::vector<unsigned char>& lit) {
    assert(pair.hasStandardError());
    const Image& errors = pair.standardError();
    ReferenceNoise noise;
    noise.rmse =
        std::sqrt(mean(pair, errors, errors, [](double sigma, double) { return squared(sigma); }));
    const double absolute = std::sqrt(2.0 / std::numbers::pi);  // of a normal deviation of 1
    noise.mae = absolute * mean(pair, errors, errors, [](double sigma, double) { return sigma; });
    noise.smape = meanOfLit(lit, errors, pair.reference(), [&](double sigma, double r) {
        return sigma > 0.0 ? std::min(absolute * sigma / (2.0 * std::max(r, 1e-300)), 1.0) : 0.0;
    });
    if (epsilon > 0.0) {
        noise.relMse = mean(pair, errors, pair.reference(), [epsilon](double sigma, double r) {
            return squared(sigma) / (squared(r) + epsilon);
        });
    }
    double variance = 0.0;
    for (std::size_t pixel = 0; pixel < pair.pixelCount(); ++pixel) {
        const float* const sigma = errors.values.data() + 3 * pixel;
        variance += squared(pair.area(pixel) *
                            (static_cast<double>(sigma[0]) + static_cast<double>(sigma[1]) +
                             static_cast<double>(sigma[2])));
    }
    const double flux = totalFlux(pair, pair.reference());
    if (flux != 0.0) noise.energyRatio = std::sqrt(variance) / std::abs(flux);
    return noise;
}

Image signedError(const ImagePair& pair) {
    Image error = pair.image();
    for (std::size_t i = 0; i < error.values.size(); ++i)
        error.values[i] -= pair.reference().values[i];
    return error;
}

Image absoluteError(const ImagePair& pair) {
    Image error = signedError(pair);
    for (float& value : error.values)
        value = std::abs(value);
    return error;
}

}  // namespace kaustik::measure
