// SPDX-License-Identifier: MIT
#include "framework/judge/acceptance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "framework/core/error.h"
#include "framework/judge/pictures.h"

namespace kaustik::judge {
namespace {

// Filters with negative lobes undershoot next to edges by up to a tenth of the step.
constexpr double kMaxUndershoot = 0.05;  // of the mean, below 0
// Of the caustics' light, in pixels that count: of less the rest cannot be inferred.
constexpr double kMinVisibleShare = 0.02;
// Of the caustic, for a class of its own: fainter ones are below the floor of noise in each pixel.
constexpr double kMinClassShare = 5e-4;
constexpr double kMaxOffLevel = 0.1;  // of 8 bits: what rounding to half floats does
constexpr std::ptrdiff_t kMinLevels = 16;
constexpr std::size_t kMinCutOffPixels = 12;
// The reference's brightest tenth where theirs is cut off, over its darkest.
constexpr float kMinCutOffRange = 1.3f;

// By the sRGB curve, 0 to 1.
double encoded(double value) {
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

// Whether all values are those of 8 bits, as they are or with the sRGB curve taken off. A picture
// of a few levels may be one by chance.
bool isOfEightBits(const Image& theirs) {
    std::array<bool, 256> isLinear{};
    std::array<bool, 256> isCurved{};
    bool mayBeLinear = true;
    bool mayBeCurved = true;
    for (const float value : theirs.values) {
        const auto of = static_cast<double>(value);
        if (of < 0.0 || of > 1.0) return false;
        const auto note = [](double level, std::array<bool, 256>& levels, bool& mayBe) {
            const double nearest = std::round(level);
            // Half floats are good to 0.06 of a level.
            mayBe = mayBe && std::abs(level - nearest) < kMaxOffLevel;
            levels[static_cast<std::size_t>(std::clamp(nearest, 0.0, 255.0))] = true;
        };
        note(255.0 * of, isLinear, mayBeLinear);
        note(255.0 * encoded(of), isCurved, mayBeCurved);
        if (!mayBeLinear && !mayBeCurved) return false;
    }
    const std::array<bool, 256>& levels = mayBeLinear ? isLinear : isCurved;
    return std::count(levels.begin(), levels.end(), true) >= kMinLevels;
}

}  // namespace

void requireNumbers(const Image& theirs, const std::string& name) {
    double greatest = 0.0;
    double mean = 0.0;
    for (const float value : theirs.values) {
        if (!std::isfinite(value)) {
            throw ConfigError(
                fmt::format("{} holds values that are no numbers; it cannot be judged.", name));
        }
        greatest = std::max(greatest, static_cast<double>(value));
        mean += static_cast<double>(value) / static_cast<double>(theirs.values.size());
    }
    if (isOfEightBits(theirs)) {
        throw ConfigError(
            fmt::format("{} has no more than 256 levels, as pictures for a display do; save linear "
                        "light as floating point.",
                        name));
    }
    // Filters with negative lobes and noise go a little below 0.
    const auto negative = static_cast<std::size_t>(
        std::count_if(theirs.values.begin(), theirs.values.end(), [mean](float value) {
            return static_cast<double>(value) < -kMaxUndershoot * std::abs(mean);
        }));
    if (!(greatest > 0.0))
        throw ConfigError(fmt::format("{} is black; there is nothing to judge.", name));
    if (negative > theirs.values.size() / 20) {
        throw ConfigError(fmt::format(
            "{} is negative in {:.0f} % of its values, which no light is.", name,
            100.0 * static_cast<double>(negative) / static_cast<double>(theirs.values.size())));
    }
}

void requireCaustic(const Subject& subject, const Image& mask) {
    double whole = 0.0;
    double inMask = 0.0;
    for (const Light& light : subject.classes) {
        whole += total(light.radiance, subject.mask);
        inMask += total(light.radiance, mask);
    }
    if (!(whole > 0.0)) {
        throw ConfigError(
            fmt::format("In this view of {} there is no caustic to judge by.", subject.scene));
    }
    if (inMask < kMinVisibleShare * whole) {
        throw ConfigError(fmt::format(
            "The eye sees the caustics of {} through glass or water, which {} seems to show; "
            "render them without (--glass hidden says that it was), unless it is of another scene.",
            subject.scene, subject.theirsName));
    }
}

void joinFaintClasses(Subject& subject) {
    double light = 0.0;
    for (const Light& of : subject.classes)
        light += total(of.radiance, subject.mask);
    std::vector<Light> kept;
    std::optional<Light> rest;
    for (Light& of : subject.classes) {
        const bool isFaint = total(of.radiance, subject.mask) < kMinClassShare * light;
        if (!isFaint && of.name != "other") {
            kept.push_back(std::move(of));
        } else if (!rest) {
            rest = std::move(of);
            rest->name = "other";
        } else {
            for (std::size_t i = 0; i < rest->radiance.values.size(); ++i)
                rest->radiance.values[i] += of.radiance.values[i];
            for (std::size_t i = 0; i < std::min(rest->error.values.size(), of.error.values.size());
                 ++i)
                rest->error.values[i] = std::hypot(rest->error.values[i], of.error.values[i]);
        }
    }
    if (rest) kept.push_back(std::move(*rest));
    subject.classes = std::move(kept);
}

void requireNotCutOff(const Comparison& comparison, const Image& model) {
    const float greatest =
        *std::max_element(comparison.theirs.values.begin(), comparison.theirs.values.end());
    std::vector<float> there;
    std::size_t counted = 0;
    for (int y = 0; y < model.height; ++y) {
        for (int x = 0; x < model.width; ++x) {
            if (comparison.counted.at(x, y, 0) < 0.5f) continue;
            ++counted;
            const glm::dvec2 place = comparison.registration.placeOf(glm::dvec2(x + 0.5, y + 0.5),
                                                                     model, comparison.theirs);
            const int column = static_cast<int>(std::floor(
                comparison.registration.isFlippedX ? comparison.theirs.width - place.x : place.x));
            const int row = static_cast<int>(std::floor(
                comparison.registration.isFlippedY ? comparison.theirs.height - place.y : place.y));
            if (column < 0 || row < 0 || column >= comparison.theirs.width ||
                row >= comparison.theirs.height)
                continue;
            if (comparison.theirs.at(column, row, 1) >= greatest * 0.9999f)
                there.push_back(model.at(x, y, 1));
        }
    }
    if (there.size() < kMinCutOffPixels || there.size() < counted / 500) return;
    std::sort(there.begin(), there.end());
    const float low = there[there.size() / 10];
    const float high = there[there.size() - 1 - there.size() / 10];
    if (high > kMinCutOffRange * low) {
        throw ConfigError(fmt::format(
            "{} is cut off at {:.4g}, in {:.1f} % of its pixels, as pictures for a display are; "
            "save linear light as floating point.",
            comparison.subject.theirsName, greatest,
            100.0 * static_cast<double>(there.size()) / static_cast<double>(counted)));
    }
}

}  // namespace kaustik::judge
