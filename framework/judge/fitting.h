// SPDX-License-Identifier: MIT
// Fits of the columns of a comparison to their picture.
#pragma once

#include <vector>

#include "framework/judge/comparison.h"

namespace kaustik::judge {

// Coefficients that differ by more standard errors than this do so for a reason: of a normal
// variate 6 in 100,000 do by chance.
constexpr double kSignificantErrors = 4.0;

// Makes the normal equations of all columns, of the picture and its weights.
void makeEquations(Comparison& comparison);
// Of some columns, by the equations; light and causes are not below 0.
[[nodiscard]] LinearFit fit(const Comparison& comparison, const std::vector<std::size_t>& columns);

// The same with one more column whose coefficient is known.
[[nodiscard]] LinearFit fitBeside(const Comparison& comparison,
                                  const std::vector<std::size_t>& columns, std::size_t known,
                                  double coefficient);

// Where a column is among those that were fitted.
[[nodiscard]] std::size_t placeOf(const LinearFit& fitted, std::size_t column);
// 0 for a column that was not fitted.
[[nodiscard]] double coefficientOf(const LinearFit& fitted, std::size_t column);
// Of what the coefficients of the light are about: direct light's, or the largest class's.
[[nodiscard]] double lightOf(const Comparison& comparison, const LinearFit& fitted);
[[nodiscard]] Image predictionOf(const Comparison& comparison, const LinearFit& fitted);

// The covariance of what is fitted, by sums over blocks of pixels, so that noise that neighbours
// share is in it; it is never taken for less than what independent pixels would give. As large as
// the fitted set, with nothing for what is held at 0.
[[nodiscard]] Symmetric covarianceOf(const Comparison& comparison, const LinearFit& fitted);

}  // namespace kaustik::judge
