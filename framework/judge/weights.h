// SPDX-License-Identifier: MIT
// How much each pixel counts: by its light where nothing else is known yet, then by its noise.
#pragma once

#include "framework/judge/comparison.h"

namespace kaustik::judge {

// In standard deviations, what is far off; near Huber's own 1.345.
constexpr double kFarOff = 1.5;

// Sets `weight` as if pixels were wrong by a share of their light.
void weighByLight(Comparison& comparison);
// Huber's weights, from `plainWeight`: what is far off counts by its size and not by its square,
// since where the two pictures differ most there is some other mistake. Gives the mean loss.
double reweighFarOff(Comparison& comparison, const LinearFit& fitted);
// Sets `weight` and `deviation` by the noise of both pictures, the errors of mistakes that were
// made as a whole, and the equations.
void weighByNoise(Comparison& comparison);
// Sets `blurPixels` to the Gaussian by which the reference's caustics fit best, or to 0.
void decideBlur(Comparison& comparison);

}  // namespace kaustik::judge
