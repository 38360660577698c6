// SPDX-License-Identifier: MIT
// What there is to say of the classes of paths.
#include <fmt/format.h>

#include <cmath>

#include "framework/judge/findings.h"
#include "framework/judge/sentences.h"
#include "framework/judge/significance.h"

namespace kaustik::judge {
namespace {

// All classes have one factor where chi squared of their distances from the mean is no rarer than
// this. Besides its standard error each may be off by a share of the mean, as renderers' own meshes
// and kernels make it.
constexpr double kFalseAlarmRate = 0.01;
constexpr double kCommonTolerance = 0.02;

std::vector<std::string> alsoOf(const Evidence& evidence, Role role, std::size_t index) {
    for (const Choice& choice : evidence.choices) {
        if (choice.candidate.role == role && choice.candidate.index == index) return choice.also;
    }
    return {};
}

// Whether all classes that can be told are off by the same; said once then.
bool addCommonFactor(const Comparison& comparison, const Evidence& evidence,
                     std::vector<Finding>& findings) {
    if (!comparison.hasDirect && !comparison.options.exposure) return false;
    double weights = 0.0;
    double mean = 0.0;
    std::size_t off = 0;
    std::size_t told = 0;
    for (const ClassVerdict& of : evidence.classes) {
        if (of.verdict == "cannot be told" || !(of.error > 0.0)) continue;
        ++told;
        off += of.verdict != "there" ? 1u : 0u;
        const double weight =
            1.0 / (of.error * of.error + std::pow(kCommonTolerance * of.coefficient, 2.0) + 1e-6);
        weights += weight;
        mean += weight * of.coefficient;
    }
    if (told < 2 || off == 0) return false;
    mean /= weights;
    double chiSquared = 0.0;
    for (const ClassVerdict& of : evidence.classes) {
        if (of.verdict == "cannot be told" || !(of.error > 0.0)) continue;
        chiSquared += std::pow(of.coefficient - mean, 2.0) /
                      (of.error * of.error + std::pow(kCommonTolerance * mean, 2.0));
    }
    if (chiSquaredTail(chiSquared, told - 1) < kFalseAlarmRate) return false;
    if (std::abs(mean - 1.0) < kCoefficientTolerance) return false;
    const double error = 1.0 / std::sqrt(weights);
    findings.push_back(
        {mean < kMaxMissing ? "missing:all"
         : mean > 1.0       ? "bright:all"
                            : "dark:all",
         mean, error,
         mean < kMaxMissing
             ? fmt::format("all caustic light is missing: c = {:.3f} ± {:.2g}", mean, error)
             : fmt::format("all caustic light is too {} against direct light: c = {:.3f} ± "
                           "{:.2g}{}",
                           mean > 1.0 ? "bright" : "dark", mean, error,
                           meaningOf(comparison, mean, error)),
         alsoOf(evidence, Role::allClasses, 0)});
    return true;
}

}  // namespace

void addClasses(const Comparison& comparison, const Evidence& evidence,
                std::vector<Finding>& findings) {
    if (addCommonFactor(comparison, evidence, findings)) return;
    for (std::size_t k = 0; k < evidence.classes.size(); ++k) {
        const ClassVerdict& of = evidence.classes[k];
        const std::string who = fmt::format("{} ({}, {:.1f} % of the caustic)", of.title, of.name,
                                            100.0 * of.fluxShare);
        const std::string value = fmt::format("c = {:.3f} ± {:.2g}", of.coefficient, of.error);
        if (of.verdict == "missing") {
            findings.push_back({"missing:" + of.name, of.coefficient, of.error,
                                fmt::format("{} is missing: {}", who, value),
                                alsoOf(evidence, Role::lightClass, k)});
        } else if (of.verdict == "too bright" || of.verdict == "too dark") {
            findings.push_back(
                {of.verdict == "too bright" ? "bright:" + of.name : "dark:" + of.name,
                 of.coefficient, of.error,
                 fmt::format("{} is {}: {}{}", who, of.verdict, value,
                             meaningOf(comparison, of.coefficient, of.error)),
                 alsoOf(evidence, Role::lightClass, k)});
        }
    }
}

}  // namespace kaustik::judge
