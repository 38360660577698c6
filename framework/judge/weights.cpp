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
// A mistake with this share of the light's coefficient may have been made as a whole.
constexpr double kMinWholeShare = 0.25;

// By how much values bend to their neighbours', along the axes that are interpolated: there or next
// to it, since in the middle of an edge between two pixels they do not bend.
Image curvatureOf(const Image& image, const glm::dvec2& shift) {
    Image result(image.width, image.height, image.channels);
    const auto at = [&](int x, int y, int c) {
        return image.at(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1), c);
    };
    const auto greatest = [&](int x, int y, int c, int dx, int dy) {
        float bend = 0.0f;
        for (int i = -1; i <= 1; ++i) {
            const int column = x + i * dx;
            const int row = y + i * dy;
            bend =
                std::max(bend, std::abs(at(column - dx, row - dy, c) +
                                        at(column + dx, row + dy, c) - 2.0f * at(column, row, c)));
        }
        return bend;
    };
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < image.channels; ++c) {
                float& sum = result.at(x, y, c);
                if (shift.x != 0.0) sum += greatest(x, y, c, 1, 0);
                if (shift.y != 0.0) sum += greatest(x, y, c, 0, 1);
            }
        }
    }
    return result;
}

// What of chi squared a blur may take away for there being less noise: of the classes, whose noise
// is known and taken off in the mean, what chance makes of it; of mistakes, where it is estimated,
// all of it.
double gainByNoise(const Comparison& comparison, const LinearFit& fitted) {
    double squares = 0.0;
    double estimated = 0.0;
    for (std::size_t i = 0; i < comparison.weight.values.size(); ++i) {
        double known = 0.0;
        for (std::size_t j = 0; j < fitted.columns.size(); ++j) {
            const Column& column = comparison.columns[fitted.columns[j]];
            if (isEmpty(column.error)) continue;
            const double variance =
                static_cast<double>(comparison.weight.values[i]) *
                std::pow(fitted.values[j] * static_cast<double>(column.error.values[i]), 2.0);
            (column.role == Role::cause ? estimated : known) += variance;
        }
        squares += known * known;
    }
    return kSignificantErrors * std::sqrt(2.0 * squares) + estimated;
}

// A mistake that was made as a whole brings noise of its own: it is not the difference of the same
// photons' paths. Sets its error by how what is left differs from pixel to pixel where it is as
// large; gives the variance of those that are in the fit.
Image estimateNoiseOfMistakes(Comparison& comparison, const LinearFit& fitted,
                              const Image& residual, const Image& known) {
    Image variance(residual.width, residual.height, 3);
    const double light = lightOf(comparison, fitted);
    for (const std::size_t place : columnsOf(comparison, {Role::cause})) {
        Column& column = comparison.columns[place];
        Cause& cause = comparison.subject.causes[column.index];
        const double made = coefficientOf(fitted, place);
        if (cause.kind != CauseKind::whole || !(made > kMinWholeShare * light)) continue;
        Image size = column.image;
        for (float& value : size.values)
            value = std::abs(value);
        column.error = noiseOf(residual, size, known, comparison.counted);
        for (std::size_t i = 0; i < variance.values.size(); ++i) {
            variance.values[i] += column.error.values[i] * column.error.values[i];
            column.error.values[i] /= static_cast<float>(made);
        }
        if (!(comparison.blurPixels > 0.0)) cause.error = column.error;
    }
    return variance;
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
        const Image byMistakes = estimateNoiseOfMistakes(comparison, fitted, residual, known);
        const Image curvature = curvatureOf(prediction, comparison.columnShift);
        comparison.deviation = Image(comparison.picture.width, comparison.picture.height, 3);
        for (std::size_t i = 0; i < noise.values.size(); ++i) {
            const auto light = static_cast<double>(prediction.values[i]);
            const double interpolated =
                kInterpolationError * static_cast<double>(curvature.values[i]);
            const double variance =
                interpolated * interpolated + std::pow(static_cast<double>(noise.values[i]), 2.0) +
                std::pow(static_cast<double>(known.values[i]), 2.0) +
                static_cast<double>(byMistakes.values[i]) +
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
    const auto fitBlurred = [&](double sigma) {
        comparison.blurPixels = sigma;
        makeColumns(comparison, true);
        makeEquations(comparison);
        return fit(comparison, columnsOf(comparison, {Role::direct, Role::lightClass, Role::cause,
                                                      Role::fill}));
    };
    const LinearFit plain = fitBlurred(0.0);
    const double sharp = plain.chiSquared;
    const double byNoise = gainByNoise(comparison, plain);
    double best = sharp;
    double found = 0.0;
    constexpr std::array kSigmas = {0.3, 0.4, 0.5, 0.65, 0.8, 1.0, 1.25, 1.6, 2.0, 2.5, 3.2, 4.0};
    for (const double sigma : kSigmas) {
        const double now = fitBlurred(sigma).chiSquared;
        if (now >= best) continue;
        best = now;
        found = sigma;
    }
    // In units of what is left of a value: the likelihood ratio's test of one parameter.
    const auto rows = static_cast<double>(comparison.equations.rows);
    const double unit = std::max(1.0, best / std::max(rows, 1.0));
    double critical =
        unit *
        criticalChiSquared(chanceOfEach(kFalseAlarmRate, static_cast<double>(kSigmas.size())), 1);
    critical = std::max(critical, byNoise);
    if (best > kMaxLossOfBlur * sharp || sharp - best < critical || found < kMinBlurPixels)
        found = 0.0;
    comparison.blurPixels = found;
    makeColumns(comparison, true);
}

}  // namespace kaustik::judge
