// SPDX-License-Identifier: MIT
// A ball before an even environment, of whose silhouette it is known how much it covers of each
// pixel.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <glm/glm.hpp>
#include <string>

#include "tests/gpu/fixture.h"

namespace kaustik::test {

inline constexpr double kBallDistance = 4.0;  // m, of its middle from the eye
inline constexpr double kBallRadius = 1.0;

// `material`: the keys of its material but for the name. The environment has 1 W/m²/sr.
[[nodiscard]] inline scene::Scene ballBeforeEnvironment(const std::string& material) {
    return sceneFromText(fmt::format(R"(
name = 'ball'
background_radiance = 1
[camera]
position = [0, 0, {}]
target = [0, 0, 0]
vertical_fov_degrees = 45
[[light]]
name = "sun"
type = "directional"
irradiance = 1
direction = [0, -1, 0]
[[material]]
name = "of-ball"
{}
[[object]]
name = "ball"
shape = "sphere"
material = "of-ball"
radius = {}
segments = 128
)",
                                     kBallDistance, material, kBallRadius));
}

// The share of a pixel that the ball covers, by 1024 points. `ray`: through the pixel's middle, at
// a depth of 1 m; `side`: what the pixel measures there.
[[nodiscard]] inline double coveredByBall(const glm::dvec2& ray, double side) {
    constexpr int kParts = 32;
    // The cone around the ball: its tangent of the half-angle.
    const double edge =
        kBallRadius / std::sqrt(kBallDistance * kBallDistance - kBallRadius * kBallRadius);
    int inside = 0;
    for (int i = 0; i < kParts * kParts; ++i) {
        const glm::dvec2 offset((i % kParts + 0.5) / kParts - 0.5,
                                (i / kParts + 0.5) / kParts - 0.5);
        inside += glm::length(ray + side * offset) < edge ? 1 : 0;
    }
    return static_cast<double>(inside) / (kParts * kParts);
}

}  // namespace kaustik::test
