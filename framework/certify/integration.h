// SPDX-License-Identifier: MIT
// Integrals over polygons of a cell of what is enclosed there by a TaylorModel.
#pragma once

#include "framework/certify/ray.h"

namespace kaustik::certify {

// A bound of the integral over one polygon: the upper one, or the lower.
[[nodiscard]] double integralBound(const TaylorModel& model, const Polygon& polygon, bool isUpper);
// W, the mean of channels, between all that is sure and all that may be. `channels`: how many
// fluxes differ, 1 or 3.
[[nodiscard]] Interval wattsOf(const Ray& ray, const Polygons& sure, const Polygons& may,
                               int channels);

}  // namespace kaustik::certify
