// SPDX-License-Identifier: MIT
// The checks that all procedural shapes share.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "framework/core/error.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene {

inline void requirePositive(const char* member, double value) {
    if (std::isfinite(value) && value > 0.0) return;
    throw ConfigError(fmt::format("{} must be greater than 0, not {}.", member, value));
}

inline void requireCells(const char* member, unsigned value, unsigned minimum) {
    if (value >= minimum && value <= kMaximumCells) return;
    throw ConfigError(
        fmt::format("{} must be from {} to {}, not {}.", member, minimum, kMaximumCells, value));
}

}  // namespace kaustik::scene
