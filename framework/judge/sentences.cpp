// SPDX-License-Identifier: MIT
#include "framework/judge/sentences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace kaustik::judge {
namespace {

constexpr double kPi = 3.14159265358979323846;
// How far a factor may be from a known one, relative (what meshes and kernels make of one), or in
// standard errors; and how far an angle's tangents may be from the picture's aspect. These choose
// words alone.
constexpr double kFactorTolerance = 0.015;
constexpr double kFactorErrors = 2.0;
constexpr double kAspectTolerance = 0.02;

std::string plusMinus(double value, const std::vector<double>& errors, const char* format) {
    std::string result = fmt::format(fmt::runtime(format), value);
    if (!errors.empty()) result += " ± " + fmt::format(fmt::runtime("{:.2g}"), errors.front());
    return result;
}

}  // namespace

std::string sentenceOf(const Comparison& comparison, const Candidate& candidate,
                       const std::vector<double>& amounts, const std::vector<double>& errors) {
    const double amount = amounts.front();
    switch (candidate.role) {
        case Role::lightClass:
            return fmt::format("{} ({}) has another strength: c = {}",
                               titleOf(comparison.subject.classes[candidate.index].name),
                               comparison.subject.classes[candidate.index].name,
                               plusMinus(1.0 + amount, errors, "{:.3f}"));
        case Role::allClasses:
            return fmt::format("all caustic light has another strength: c = {}",
                               plusMinus(1.0 + amount, errors, "{:.3f}"));
        case Role::shiftX:
            return fmt::format("the picture is moved by ({:+.2f}, {:+.2f}) pixels", -amounts[0],
                               -amounts[1]);
        case Role::scale:
            return fmt::format("the vertical field of view is {:.3f} degrees instead of {:.3f}",
                               fieldOfViewOf(comparison, 1.0 - amount),
                               comparison.subject.verticalFovDegrees);
        case Role::fill:
            return fmt::format(
                "receivers have an even light of {} W/m² that is not the "
                "scene's (ambient light, or light between them)",
                plusMinus(amount, errors, "{:.3g}"));
        default: {
            const Cause& cause = comparison.subject.causes[candidate.index];
            if (cause.kind == CauseKind::whole) return cause.sentence;
            return fmt::format("{} is off by {}{}{}", cause.name,
                               plusMinus(amount, errors, "{:+.3g}"), cause.unit.empty() ? "" : " ",
                               cause.unit);
        }
    }
}

double fieldOfViewOf(const Comparison& comparison, double scale) {
    const double tangent = std::tan(0.5 * comparison.subject.verticalFovDegrees * kPi / 180.0);
    return 2.0 * std::atan(tangent / scale) * 180.0 / kPi;
}

std::string aspectHint(const Comparison& comparison, double zoom) {
    const Image& ours = comparison.columns.front().image;
    const double aspect = static_cast<double>(ours.width) / ours.height;
    if (std::abs(zoom * aspect - 1.0) < kAspectTolerance) return ": that is the horizontal one";
    if (std::abs(zoom / aspect - 1.0) < kAspectTolerance)
        return ": what is vertical here was taken for the horizontal one";
    return "";
}

std::string meaningOf(const Comparison& comparison, double value, double error) {
    std::vector<std::pair<double, std::string>> known = {
        {1.0 / kPi, "1/π"}, {kPi, "π"}, {0.5, "a half"}, {2.0, "twice"}, {4.0, "four times"}};
    for (const NamedIndex& index : comparison.subject.indices) {
        const double square = index.index * index.index;
        known.emplace_back(1.0 / square, fmt::format("1/n² of '{}'", index.material));
        known.emplace_back(square, fmt::format("n² of '{}'", index.material));
    }
    for (const auto& [factor, name] : known) {
        if (std::abs(value - factor) < std::max(kFactorErrors * error, kFactorTolerance * factor))
            return fmt::format(", which is {} ({:.3f})", name, factor);
    }
    return "";
}

}  // namespace kaustik::judge
