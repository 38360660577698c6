// SPDX-License-Identifier: MIT
#include "framework/judge/weights.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/judge/fitting.h"
#include "framework/judge/pictures.h"
#include "framework/judge/significance.h"

namespace kaustik::judge {
namespace {

// What no picture is better than: interpolation, 16-bit floats (0.05 %), the edges of triangles.
// Without a floor a few pixels that have no noise would outweigh all others.
constexpr double kNoiseFloorOfLight = 0.003;  // of the light in a pixel
constexpr double kNoiseFloorOfMean = 0.001;   // of the mean of all
// What interpolation a quarter of a pixel off does not know of a light that is narrower than
// pixels: the error of a straight line between them, f (1 - f) / 2 of how much it bends.
constexpr double kInterpolationError = 0.1;
// By light alone: a pixel is taken to be wrong by this share of its light and of the mean.
constexpr double kFirstDeviation = 0.05;
// A pixel's own box has a standard deviation of 0.29: less is how pixels are filtered.
constexpr double kMinBlurPixels = 0.35;
// A blur must leave less than this share of what is unexplained without it, and be no chance among
// those that are tried. Any blur makes a reference with noise fit a little better.
constexpr double kMaxLossOfBlur = 0.95;
constexpr double kFalseAlarmRate = 0.01;

// By how much values bend to their neighbours', along the axes that are interpolated.
Image curvatureOf(const Image& image, const glm::dvec2& shift) {
    Image result(image.width, image.height, image.channels);
    const auto at = [&](int x, int y, int c) {
        return image.at(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1), c);
    };
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < image.channels; ++c) {
                float& sum = result.at(x, y, c);
                const float twice = 2.0f * at(x, y, c);
                if (shift.x != 0.0) sum += std::abs(at(x - 1, y, c) + at(x + 1, y, c) - twice);
                if (shift.y != 0.0) sum += std::abs(at(x, y - 1, c) + at(x, y + 1, c) - twice);
            }
        }
    }
    return result;
}

}  // namespace

void weighByLight(Comparison& comparison) {
    const Image& model = comparison.columns.front().image;
    const Image& counted = comparison.counted;
    const double pixels = std::max(pixelCount(counted), 1.0);
    const double mean = total(model, counted) / (3.0 * pixels);
    comparison.weight = Image(model.width, model.height, 3);
    for (std::size_t i = 0; i < comparison.weight.values.size(); ++i) {
        const double light = static_cast<double>(model.values[i]);
        comparison.weight.values[i] =
            static_cast<float>(comparison.counted.values[i / 3] > 0.5f
                                   ? 1.0 / (std::pow(kFirstDeviation * light, 2.0) +
                                            std::pow(kFirstDeviation * mean, 2.0))
                                   : 0.0);
    }
}

double reweighFarOff(Comparison& comparison, const LinearFit& fitted) {
    const Image prediction = predictionOf(comparison, fitted);
    double loss = 0.0;
    for (std::size_t i = 0; i < comparison.weight.values.size(); ++i) {
        const auto weight = static_cast<double>(comparison.plainWeight.values[i]);
        if (!(weight > 0.0)) continue;
        const double off =
            std::abs(static_cast<double>(comparison.picture.values[i] - prediction.values[i])) *
            std::sqrt(weight);
        comparison.weight.values[i] =
            static_cast<float>(weight * std::min(1.0, kFarOff / std::max(off, 1e-12)));
        loss += off < kFarOff ? 0.5 * off * off : kFarOff * (off - 0.5 * kFarOff);
    }
    return loss / std::max(static_cast<double>(comparison.equations.rows), 1.0);
}

void weighByNoise(Comparison& comparison) {
    weighByLight(comparison);
    for (int round = 0; round < 2; ++round) {
        makeEquations(comparison);
        const std::vector<std::size_t> columns = columnsOf(
            comparison,
            {Role::direct, Role::lightClass, Role::cause, Role::shiftX, Role::shiftY, Role::fill});
        LinearFit fitted = fit(comparison, columns);
        if (!fitted.isSolved())
            fitted = fit(comparison, columnsOf(comparison, {Role::direct, Role::lightClass}));
        Image prediction = predictionOf(comparison, fitted);
        Image residual(comparison.picture.width, comparison.picture.height, 3);
        for (std::size_t i = 0; i < residual.values.size(); ++i)
            residual.values[i] = comparison.picture.values[i] - prediction.values[i];
        for (float& value : prediction.values)
            value = std::max(value, 0.0f);
        Image known(comparison.picture.width, comparison.picture.height, 3);
        if (!isEmpty(comparison.columns.front().error)) known = comparison.columns.front().error;
        Image noise = isEmpty(comparison.theirsError)
                          ? noiseOf(residual, prediction, known, comparison.counted)
                          : comparison.theirsError;
        const double mean = total(prediction, comparison.counted) /
                            std::max(3.0 * pixelCount(comparison.counted), 1.0);
        const Image curvature = curvatureOf(prediction, comparison.columnShift);
        comparison.deviation = Image(comparison.picture.width, comparison.picture.height, 3);
        for (std::size_t i = 0; i < noise.values.size(); ++i) {
            const auto light = static_cast<double>(prediction.values[i]);
            const double interpolated =
                kInterpolationError * static_cast<double>(curvature.values[i]);
            const double variance =
                interpolated * interpolated + std::pow(static_cast<double>(noise.values[i]), 2.0) +
                std::pow(static_cast<double>(known.values[i]), 2.0) +
                std::pow(kNoiseFloorOfLight * light, 2.0) + std::pow(kNoiseFloorOfMean * mean, 2.0);
            comparison.deviation.values[i] = static_cast<float>(std::sqrt(variance));
            comparison.weight.values[i] = comparison.counted.values[i / 3] > 0.5f && variance > 0.0
                                              ? static_cast<float>(1.0 / variance)
                                              : 0.0f;
        }
    }
    makeEquations(comparison);
}

void decideBlur(Comparison& comparison) {
    const auto unexplained = [&](double sigma) {
        comparison.blurPixels = sigma;
        makeColumns(comparison, true);
        makeEquations(comparison);
        return fit(comparison,
                   columnsOf(comparison, {Role::direct, Role::lightClass, Role::cause, Role::fill}))
            .chiSquared;
    };
    const double sharp = unexplained(0.0);
    double best = sharp;
    double found = 0.0;
    constexpr std::array kSigmas = {0.3, 0.4, 0.5, 0.65, 0.8, 1.0, 1.25, 1.6, 2.0, 2.5, 3.2, 4.0};
    for (const double sigma : kSigmas) {
        const double now = unexplained(sigma);
        if (now >= best) continue;
        best = now;
        found = sigma;
    }
    // In units of what is left of a value: the likelihood ratio's test of one parameter.
    const double unit =
        std::max(1.0, best / std::max(static_cast<double>(comparison.equations.rows), 1.0));
    const double critical =
        unit *
        criticalChiSquared(chanceOfEach(kFalseAlarmRate, static_cast<double>(kSigmas.size())), 1);
    if (best > kMaxLossOfBlur * sharp || sharp - best < critical || found < kMinBlurPixels)
        found = 0.0;
    comparison.blurPixels = found;
    makeColumns(comparison, true);
}

}  // namespace kaustik::judge
