// SPDX-License-Identifier: MIT
#include "framework/measure/bias.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "framework/measure/color.h"

namespace kaustik::measure {
namespace {

// The median standard error of the pixels that the reference has reached; 0 where it has none.
double typicalError(const ImagePair& pair, const Plane<double>& sigmas) {
    std::vector<double> errors;
    for (std::size_t pixel = 0; pixel < pair.pixelCount(); ++pixel) {
        if (pair.counts(pixel) && sigmas.values[pixel] > 0.0)
            errors.push_back(sigmas.values[pixel]);
    }
    if (errors.empty()) return 0.0;
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    return *middle;
}

// By pixel; none where nothing is judged.
std::vector<std::optional<double>> zScores(const ImagePair& pair) {
    const Plane<double> image = luminancePlane(pair.image());
    const Plane<double> reference = luminancePlane(pair.reference());
    const Plane<double> sigmas = luminancePlane(pair.standardError());
    const double typical = typicalError(pair, sigmas);
    std::vector<std::optional<double>> scores(pair.pixelCount());
    if (!(typical > 0.0)) return scores;
    for (std::size_t pixel = 0; pixel < scores.size(); ++pixel) {
        if (!pair.counts(pixel)) continue;
        const double sigma = sigmas.values[pixel] > 0.0 ? sigmas.values[pixel] : typical;
        scores[pixel] = (image.values[pixel] - reference.values[pixel]) / sigma;
    }
    return scores;
}

std::array<float, 3> colorOf(std::optional<double> z) {
    if (!z) return {0.5f, 0.5f, 0.5f};
    const double beyond = std::abs(*z) / Bias::kSignificant;
    if (!(beyond > 1.0)) return {0.05f, 0.05f, 0.05f};
    const auto t = static_cast<float>(0.35 + 0.65 * std::min((beyond - 1.0) / 9.0, 1.0));
    if (*z > 0.0) return {t, 0.62f * t, 0.0f};
    return {0.2f * t, 0.55f * t, t};
}

}  // namespace

Bias findBias(const ImagePair& pair) {
    Bias bias;
    std::size_t bright = 0;
    std::size_t dark = 0;
    for (const std::optional<double> z : zScores(pair)) {
        if (!z) continue;
        ++bias.judgedPixels;
        bright += *z > Bias::kSignificant ? 1 : 0;
        dark += *z < -Bias::kSignificant ? 1 : 0;
    }
    const double all = std::max(static_cast<double>(bias.judgedPixels), 1.0);
    bias.tooBright = static_cast<double>(bright) / all;
    bias.tooDark = static_cast<double>(dark) / all;
    return bias;
}

Image biasPicture(const ImagePair& pair) {
    const std::vector<std::optional<double>> scores = zScores(pair);
    Image picture(pair.width(), pair.height(), 3);
    for (std::size_t pixel = 0; pixel < scores.size(); ++pixel) {
        const std::array<float, 3> color = colorOf(scores[pixel]);
        std::copy(color.begin(), color.end(),
                  picture.values.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
    }
    return picture;
}

}  // namespace kaustik::measure
