// SPDX-License-Identifier: MIT
// The covariance of fitted coefficients, by sums over blocks of pixels (a sandwich estimate).
#include <algorithm>

#include "framework/judge/fitting.h"

namespace kaustik::judge {
namespace {

// Blocks along the picture's width, and their smallest side: as wide as noise that neighbours
// share (a photon map's kernel has some pixels), and still hundreds of them, so that their sum of
// squares is known to a tenth.
constexpr int kBlocksAcross = 24;
constexpr int kMinBlockPixels = 4;

// Σ over blocks of pixels of s sᵀ, s being a block's sums of weight · residual · column.
Symmetric blockSquares(const Comparison& comparison, const LinearFit& fitted,
                       const std::vector<std::size_t>& free) {
    const std::size_t n = free.size();
    const int side = std::max(kMinBlockPixels, comparison.picture.width / kBlocksAcross);
    const int across = (comparison.picture.width + side - 1) / side;
    const int down = (comparison.picture.height + side - 1) / side;
    std::vector<double> sums(static_cast<std::size_t>(across * down) * n, 0.0);
    const Image prediction = predictionOf(comparison, fitted);
    for (int y = 0; y < comparison.picture.height; ++y) {
        for (int x = 0; x < comparison.picture.width; ++x) {
            const auto block = static_cast<std::size_t>(y / side * across + x / side);
            for (int c = 0; c < 3; ++c) {
                const auto weight = static_cast<double>(comparison.weight.at(x, y, c));
                if (!(weight > 0.0)) continue;
                const double residual =
                    static_cast<double>(comparison.picture.at(x, y, c) - prediction.at(x, y, c));
                for (std::size_t j = 0; j < n; ++j) {
                    sums[block * n + j] +=
                        weight * residual *
                        static_cast<double>(comparison.columns[free[j]].image.at(x, y, c));
                }
            }
        }
    }
    Symmetric meat(n);
    for (std::size_t block = 0; block < sums.size() / std::max<std::size_t>(n, 1); ++block) {
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t k = 0; k < n; ++k)
                meat.at(j, k) += sums[block * n + j] * sums[block * n + k];
        }
    }
    return meat;
}

// inverse · meat · inverse, its diagonal at least the inverse's.
Symmetric sandwich(const Symmetric& inverse, const Symmetric& meat) {
    const std::size_t n = meat.size();
    Symmetric covariance(n);
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < n; ++k) {
            double value = 0.0;
            for (std::size_t a = 0; a < n; ++a) {
                for (std::size_t b = 0; b < n; ++b)
                    value += inverse.at(j, a) * meat.at(a, b) * inverse.at(b, k);
            }
            covariance.at(j, k) = value;
        }
    }
    for (std::size_t j = 0; j < n; ++j)
        covariance.at(j, j) = std::max(covariance.at(j, j), inverse.at(j, j));
    return covariance;
}

}  // namespace

Symmetric covarianceOf(const Comparison& comparison, const LinearFit& fitted) {
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < fitted.columns.size(); ++i) {
        if (!fitted.isHeld[i]) free.push_back(fitted.columns[i]);
    }
    const Symmetric covariance = sandwich(fitted.inverse, blockSquares(comparison, fitted, free));
    Symmetric whole(fitted.columns.size());
    std::size_t row = 0;
    for (std::size_t i = 0; i < fitted.columns.size(); ++i) {
        if (fitted.isHeld[i]) continue;
        std::size_t column = 0;
        for (std::size_t j = 0; j < fitted.columns.size(); ++j) {
            if (fitted.isHeld[j]) continue;
            whole.at(i, j) = covariance.at(row, column++);
        }
        ++row;
    }
    return whole;
}

}  // namespace kaustik::judge
