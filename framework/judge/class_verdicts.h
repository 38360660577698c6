// SPDX-License-Identifier: MIT
// The exposure, and what became of each class of paths by it.
#pragma once

#include <string>
#include <vector>

#include "framework/judge/comparison.h"

namespace kaustik::judge {

// Coefficients of classes that are nearer to 1 are right, however small their errors: what photon
// maps that have converged differ by (results/judge.md).
constexpr double kCoefficientTolerance = 0.05;
// Those below this are missing, as are those that their errors do not tell from 0: 1/n² of no
// material is as small, and 1/π is not.
constexpr double kMaxMissing = 0.1;
// A class whose coefficient has a larger error cannot be told: at four of them 0 looks like 1.
constexpr double kMaxError = 0.25;

// The last fit, of the light and of the causes that were chosen.
struct Solution {
    LinearFit fitted;
    Symmetric covariance;
};

struct Exposure {
    std::size_t place = 0;   // among the fitted columns, of what it is taken from
    double ofPicture = 1.0;  // of `picture`
    double ofTheirs = 1.0;   // of their picture as it is stored
    double errorOfTheirs = 0.0;
    std::string source;  // what it is taken from, for a sentence
};

// Throws ConfigError where there is none of the light that it would be taken from.
[[nodiscard]] Exposure exposureOf(const Comparison& comparison, const Solution& solution);

// One of each class, in the subject's order.
[[nodiscard]] std::vector<ClassVerdict> classVerdictsOf(const Comparison& comparison,
                                                        const Solution& solution,
                                                        const Exposure& exposure);

}  // namespace kaustik::judge
