// SPDX-License-Identifier: MIT
#include "framework/certify/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/core/error.h"

namespace kaustik::certify {
namespace {

enum class Finding { inside, undecided, below, above };

void requireSameSize(const Image& irradiance, const Certificate& certificate) {
    const Image& lower = certificate.lower;
    if (irradiance.width == lower.width && irradiance.height == lower.height &&
        irradiance.channels >= 3)
        return;
    throw ConfigError(fmt::format("The picture has {}x{} pixels and the certificate {}x{}.",
                                  irradiance.width, irradiance.height, lower.width, lower.height));
}

Finding findingOf(const Image& irradiance, const Certificate& certificate, double dark,
                  std::size_t pixel) {
    bool undecided = false;
    bool above = false;
    for (std::size_t c = 0; c < 3; ++c) {
        const float value =
            irradiance.values[pixel * static_cast<std::size_t>(irradiance.channels) + c];
        const float low = certificate.lower.values[pixel * 3 + c];
        const float high = certificate.upper.values[pixel * 3 + c];
        if (value < low) return Finding::below;
        // What is no number is in no interval.
        above = above || !(value <= high);
        undecided = undecided || high - low > 0.2f * high;
    }
    if (above) return Finding::above;
    const float* const upper = certificate.upper.values.data() + pixel * 3;
    const bool isLit = static_cast<double>(upper[0] + upper[1] + upper[2]) > dark;
    return undecided && isLit ? Finding::undecided : Finding::inside;
}

}  // namespace

Verdict judge(const Image& irradiance, const Certificate& certificate) {
    requireSameSize(irradiance, certificate);
    Verdict verdict;
    verdict.pixels = certificate.lower.values.size() / 3;
    // Where nothing goes on beyond the last interaction the certified paths are all.
    const bool isComplete = certificate.totals.limited.hi <= 0.0;
    const double dark = litAbove(certificate);
    for (std::size_t pixel = 0; pixel < verdict.pixels; ++pixel) {
        switch (findingOf(irradiance, certificate, dark, pixel)) {
            case Finding::inside:
                break;
            case Finding::undecided:
                ++verdict.undecided;
                break;
            case Finding::below:
                ++verdict.below;
                break;
            case Finding::above:
                ++(isComplete ? verdict.above : verdict.aboveCertifiedPaths);
                break;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            verdict.mean += static_cast<double>(
                irradiance.values[pixel * static_cast<std::size_t>(irradiance.channels) + c]);
            verdict.meanLow += static_cast<double>(certificate.lower.values[pixel * 3 + c]);
            verdict.meanHigh += static_cast<double>(certificate.upper.values[pixel * 3 + c]);
        }
    }
    const double count = 3.0 * static_cast<double>(verdict.pixels);
    verdict.mean /= count;
    verdict.meanLow /= count;
    verdict.meanHigh /= count;
    return verdict;
}

nlohmann::json toJson(const Verdict& verdict) {
    return {{"pixels", verdict.pixels},
            {"proved_too_dark", verdict.below},
            {"proved_too_bright", verdict.above},
            {"too_bright_for_certified_paths", verdict.aboveCertifiedPaths},
            {"undecided", verdict.undecided},
            {"mean_w_per_m2", verdict.mean},
            {"mean_between_w_per_m2", {verdict.meanLow, verdict.meanHigh}}};
}

Image verdictPicture(const Image& irradiance, const Certificate& certificate) {
    requireSameSize(irradiance, certificate);
    const bool isComplete = certificate.totals.limited.hi <= 0.0;
    const double dark = litAbove(certificate);
    Image picture(irradiance.width, irradiance.height, 3);
    // White is what one pixel of a hundred is above.
    std::vector<float> sorted;
    for (std::size_t i = 1; i < certificate.lower.values.size(); i += 3) {
        if (certificate.lower.values[i] > 0.0f) sorted.push_back(certificate.lower.values[i]);
    }
    std::sort(sorted.begin(), sorted.end());
    const float white = sorted.empty() ? 1.0f : sorted[sorted.size() * 99 / 100];
    for (std::size_t pixel = 0; pixel * 3 < picture.values.size(); ++pixel) {
        const float value =
            irradiance.values[pixel * static_cast<std::size_t>(irradiance.channels) + 1];
        const float grey = std::pow(std::clamp(value / white, 0.0f, 1.0f), 1.0f / 2.2f);
        std::array<float, 3> color{grey, grey, grey};
        const float level = 0.45f + 0.55f * grey;
        switch (findingOf(irradiance, certificate, dark, pixel)) {
            case Finding::inside:
                break;
            case Finding::undecided:
                color = {0.3f * grey, 0.3f + 0.5f * grey, 0.3f * grey};
                break;
            case Finding::below:
                color = {0.15f, 0.35f * level, level};
                break;
            case Finding::above:
                color = isComplete ? std::array<float, 3>{level, 0.15f, 0.1f}
                                   : std::array<float, 3>{level, 0.6f * level, 0.1f};
                break;
        }
        std::copy(color.begin(), color.end(),
                  picture.values.begin() + static_cast<std::ptrdiff_t>(pixel * 3));
    }
    return picture;
}

}  // namespace kaustik::certify
