// SPDX-License-Identifier: MIT
#include "framework/judge/residual.h"

#include <algorithm>
#include <cmath>

#include "framework/judge/fitting.h"
#include "framework/judge/significance.h"

namespace kaustik::judge {
namespace {

// The chance that any pixel of a right picture is significant: the usual 1 %.
constexpr double kFalseAlarmRate = 0.01;

// Counts the pixels whose z is significant.
void setSignificance(Verdict& verdict) {
    const auto pixels = static_cast<double>(std::max<std::size_t>(verdict.pixels, 1));
    verdict.criticalZ = criticalZ(chanceOfEach(kFalseAlarmRate, pixels));
    for (const float z : verdict.z.values) {
        const double size = std::abs(static_cast<double>(z));
        verdict.largestZ = std::max(verdict.largestZ, size);
        verdict.significantPixels += size > verdict.criticalZ ? 1u : 0u;
    }
}

// Why pixels are not counted, each for one reason.
void setLeftOut(const Comparison& comparison, Verdict& verdict) {
    const auto pixels = static_cast<double>(comparison.subject.mask.values.size());
    double notDiffuse = 0.0;
    double glass = 0.0;
    double outside = 0.0;
    for (std::size_t i = 0; i < comparison.subject.mask.values.size(); ++i) {
        if (comparison.counted.values[i] > 0.5f) continue;
        const bool isPlain = comparison.subject.mask.values[i] > 0.5f;
        const bool isGlass = isPlain && comparison.clear.values[i] < 0.5f;
        (!isPlain ? notDiffuse : isGlass && !comparison.glassIsHidden ? glass : outside) += 1.0;
    }
    verdict.leftOut = {notDiffuse / pixels, glass / pixels, outside / pixels};
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
    setLeftOut(comparison, verdict);
    verdict.unexplainedShare = light > 0.0 ? difference / light : 0.0;
    setSignificance(verdict);
}

}  // namespace kaustik::judge
