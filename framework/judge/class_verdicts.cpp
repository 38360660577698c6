// SPDX-License-Identifier: MIT
#include "framework/judge/class_verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/core/error.h"
#include "framework/judge/fitting.h"
#include "framework/judge/pictures.h"

namespace kaustik::judge {
namespace {

// A class is missing below this many of its standard errors.
constexpr double kMissingErrors = 3.0;

// By how much neighbours that share their noise make errors larger.
double noiseFactor(const Solution& solution, const Exposure& exposure) {
    std::size_t row = 0;
    for (std::size_t i = 0; i < exposure.place; ++i)
        row += solution.fitted.isHeld[i] ? 0u : 1u;
    return std::sqrt(solution.covariance.at(exposure.place, exposure.place) /
                     solution.fitted.inverse.at(row, row));
}

// The standard error of a class's coefficient.
double errorOf(const Comparison& comparison, const Solution& solution, const Exposure& exposure,
               std::size_t column, double coefficient) {
    const LinearFit& fitted = solution.fitted;
    const Symmetric& covariance = solution.covariance;
    const std::size_t place = placeOf(fitted, column);
    if (fitted.isDropped[place]) return HUGE_VAL;
    if (fitted.isHeld[place]) {
        // It would be negative; what it would be is known as well as if it were not, as far as the
        // exposure's error is what independent pixels would give.
        const double square = comparison.equations.matrix.at(column, column);
        return square > 0.0
                   ? noiseFactor(solution, exposure) / (std::sqrt(square) * exposure.ofPicture)
                   : HUGE_VAL;
    }
    if (!(exposure.ofPicture > 0.0)) return 0.0;
    // Of a quotient, the exposure's own error included.
    const double c = coefficient;
    const double variance =
        covariance.at(place, place) + (comparison.options.exposure
                                           ? 0.0
                                           : c * c * covariance.at(exposure.place, exposure.place) -
                                                 2.0 * c * covariance.at(place, exposure.place));
    return std::sqrt(std::max(variance, 0.0)) / exposure.ofPicture;
}

std::string verdictOf(const ClassVerdict& of) {
    if (of.error > kMaxError) return "cannot be told";
    if (std::abs(of.coefficient - 1.0) <=
        std::max(kCoefficientTolerance, kSignificantErrors * of.error))
        return "there";
    if (of.coefficient < std::max(kMaxMissing, kMissingErrors * of.error)) return "missing";
    return of.coefficient > 1.0 ? "too bright" : "too dark";
}

}  // namespace

Exposure exposureOf(const Comparison& comparison, const Solution& solution) {
    const std::size_t column = comparison.hasDirect ? columnsOf(comparison, {Role::direct}).front()
                                                    : brightestColumn(comparison);
    Exposure exposure;
    exposure.place = placeOf(solution.fitted, column);
    exposure.ofPicture = solution.fitted.values[exposure.place];
    if (!(exposure.ofPicture > 0.0)) {
        throw ConfigError(
            fmt::format("{} has nothing of the light of {} where the reference "
                        "has it; it shows another scene.",
                        comparison.subject.theirsName, comparison.subject.scene));
    }
    if (comparison.options.exposure) {
        exposure.ofPicture = *comparison.options.exposure / comparison.firstExposure;
        exposure.ofTheirs = *comparison.options.exposure;
        exposure.source = "what was said";
        return exposure;
    }
    exposure.ofTheirs = exposure.ofPicture * comparison.firstExposure;
    exposure.errorOfTheirs = std::sqrt(solution.covariance.at(exposure.place, exposure.place)) *
                             comparison.firstExposure;
    exposure.source = comparison.hasDirect
                          ? "direct light"
                          : comparison.subject.classes[comparison.columns[column].index].name;
    return exposure;
}

std::vector<ClassVerdict> classVerdictsOf(const Comparison& comparison, const Solution& solution,
                                          const Exposure& exposure) {
    std::vector<ClassVerdict> verdicts;
    double light = 0.0;
    for (const Light& of : comparison.subject.classes)
        light += total(of.radiance, comparison.counted);
    for (const std::size_t column : columnsOf(comparison, {Role::lightClass})) {
        const std::size_t place = placeOf(solution.fitted, column);
        const Light& of = comparison.subject.classes[comparison.columns[column].index];
        ClassVerdict verdict;
        verdict.name = of.name;
        verdict.title = titleOf(of.name);
        verdict.fluxShare = light > 0.0 ? total(of.radiance, comparison.counted) / light : 0.0;
        verdict.coefficient =
            exposure.ofPicture > 0.0 ? solution.fitted.values[place] / exposure.ofPicture : 0.0;
        verdict.error = errorOf(comparison, solution, exposure, column, verdict.coefficient);
        verdict.verdict = verdictOf(verdict);
        if (place == exposure.place && !comparison.options.exposure) verdict.verdict = "there";
        verdicts.push_back(verdict);
    }
    return verdicts;
}

}  // namespace kaustik::judge
