// SPDX-License-Identifier: MIT
// Density from the photons around a point: within its radius, and extrapolated to radius 0.
#pragma once

#include <numbers>

namespace kaustik::reference {

// Photons on a surface that is turned further away than this belong to another one.
inline constexpr double kMinCosine = 0.7;

// What a photon within the radius adds to the density within it, 1/m².
[[nodiscard]] inline double densityWithin(double radiusSquared) {
    return 1.0 / (std::numbers::pi * radiusSquared);
}

// What a photon adds when the density is extrapolated: twice the density within half of the area,
// less that within all of it.
[[nodiscard]] inline double densityExtrapolated(double distanceSquared, double radiusSquared) {
    const double inner = distanceSquared <= 0.5 * radiusSquared ? 4.0 : 0.0;
    return (inner - 1.0) * densityWithin(radiusSquared);
}

}  // namespace kaustik::reference
