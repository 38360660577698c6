// SPDX-License-Identifier: MIT
// A matrix as the keys position, rotation_degrees and scale of an object, where it is that.
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace kaustik::scene {

struct Placement {
    glm::dvec3 position{0.0};
    glm::dvec3 rotationDegrees{0.0};  // about the fixed axes x, then y, then z
    glm::dvec3 scale{1.0};            // applied first, > 0
    bool isMirrored = false;          // then along x as well, before all else
};

// Nothing for a matrix that shears, or that leaves no extent in some direction.
[[nodiscard]] std::optional<Placement> placementOf(const glm::dmat4& toWorld);

}  // namespace kaustik::scene
