// SPDX-License-Identifier: MIT
// Watts of light in three channels, as ledgers and reports count them. Each channel says how much
// light there would be if all of it were of that colour, so that a white light of 1000 W/m² on 1
// m², which is 1000 in each channel, emits 1000 W.
#pragma once

#include <glm/glm.hpp>

namespace kaustik::transport {

inline constexpr double kChannels = 3.0;

// The mean of the channels, W.
[[nodiscard]] inline double wattsOf(const glm::dvec3& flux) {
    return (flux.r + flux.g + flux.b) / kChannels;
}

}  // namespace kaustik::transport
