// SPDX-License-Identifier: MIT
#include "framework/scene/foreign/foreign_placement.h"

#include <algorithm>
#include <cmath>

namespace kaustik::scene {
namespace {

// The matrices come from 32-bit numbers as often as not.
constexpr double kShear = 2e-6;

// rotation = Rz Ry Rx.
glm::dvec3 anglesOf(const glm::dmat3& rotation) {
    const double sine = std::clamp(-rotation[0][2], -1.0, 1.0);
    glm::dvec3 angles(0.0, std::asin(sine), 0.0);
    if (std::abs(sine) < 1.0 - 1e-12) {
        angles.x = std::atan2(rotation[1][2], rotation[2][2]);
        angles.z = std::atan2(rotation[0][1], rotation[0][0]);
    } else {
        // x and z turn about the same axis now, so that one of them will do.
        angles.x = std::atan2(-rotation[2][1], rotation[1][1]);
    }
    return glm::degrees(angles);
}

}  // namespace

std::optional<Placement> placementOf(const glm::dmat4& toWorld) {
    glm::dmat3 axes(toWorld);
    Placement placement;
    placement.position = glm::dvec3(toWorld[3]);
    placement.isMirrored = glm::determinant(axes) < 0.0;
    if (placement.isMirrored) axes[0] = -axes[0];
    for (int i = 0; i < 3; ++i) {
        placement.scale[i] = glm::length(axes[i]);
        if (!(placement.scale[i] > 1e-12) || !std::isfinite(placement.scale[i]))
            return std::nullopt;
        axes[i] /= placement.scale[i];
    }
    for (int i = 0; i < 3; ++i) {
        if (std::abs(glm::dot(axes[i], axes[(i + 1) % 3])) > kShear) return std::nullopt;
    }
    placement.rotationDegrees = anglesOf(axes);
    return placement;
}

}  // namespace kaustik::scene
