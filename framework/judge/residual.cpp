// SPDX-License-Identifier: MIT
#include "framework/judge/residual.h"

#include <algorithm>
#include <cmath>

#include "framework/judge/fitting.h"

namespace kaustik::judge {
namespace {

// The chance that any pixel of a right picture is significant: the usual 1 %.
constexpr double kFalseAlarmRate = 0.01;

// The z that a normal variate exceeds on either side with this chance (Beasley, Springer and
// Moro's approximation would do; bisection of erfc is exact).
double criticalZ(double chance) {
    double low = 0.0;
    double high = 40.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::sqrt(2.0)) > chance ? low : high) = middle;
    }
    return high;
}

// Counts the pixels whose z is significant.
void setSignificance(Verdict& verdict) {
    const auto pixels = static_cast<double>(std::max<std::size_t>(verdict.pixels, 1));
    // Šidák's correction.
    verdict.criticalZ = criticalZ(-std::expm1(std::log1p(-kFalseAlarmRate) / pixels));
    for (const float z : verdict.z.values) {
        const double size = std::abs(static_cast<double>(z));
        verdict.largestZ = std::max(verdict.largestZ, size);
        verdict.significantPixels += size > verdict.criticalZ ? 1u : 0u;
    }
}

}  // namespace

void setResidual(const Comparison& comparison, const LinearFit& fitted, const Exposure& exposure,
                 Verdict& verdict) {
    const Image prediction = predictionOf(comparison, fitted);
    verdict.residual = Image(comparison.picture.width, comparison.picture.height, 3);
    verdict.z = Image(comparison.picture.width, comparison.picture.height, 1);
    double difference = 0.0;
    double light = 0.0;
    for (int y = 0; y < comparison.picture.height; ++y) {
        for (int x = 0; x < comparison.picture.width; ++x) {
            if (comparison.counted.at(x, y, 0) < 0.5f) continue;
            ++verdict.pixels;
            double residual = 0.0;
            double variance = 0.0;
            for (int c = 0; c < 3; ++c) {
                const double of =
                    static_cast<double>(comparison.picture.at(x, y, c) - prediction.at(x, y, c));
                verdict.residual.at(x, y, c) = static_cast<float>(of / exposure.ofPicture);
                residual += of;
                // The channels of a photon go together.
                variance += static_cast<double>(comparison.deviation.at(x, y, c));
                light += static_cast<double>(prediction.at(x, y, c));
            }
            difference += std::abs(residual);
            verdict.z.at(x, y, 0) = variance > 0.0 ? static_cast<float>(residual / variance) : 0.0f;
        }
    }
    verdict.unexplainedShare = light > 0.0 ? difference / light : 0.0;
    setSignificance(verdict);
}

}  // namespace kaustik::judge
