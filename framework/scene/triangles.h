// SPDX-License-Identifier: MIT
// The triangles of objects where they lie.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

#include "framework/scene/scene.h"

namespace kaustik::scene {

// The corners of a mesh's triangle in the space that `toSpace` leads to, which for
// Object::toWorld is world space, m.
[[nodiscard]] inline std::array<glm::dvec3, 3> cornersOf(const Mesh& mesh,
                                                         const glm::uvec3& triangle,
                                                         const glm::dmat4& toSpace) {
    std::array<glm::dvec3, 3> corners;
    for (glm::length_t i = 0; i < 3; ++i) {
        const glm::dvec3 position = mesh.origin + glm::dvec3(mesh.positions[triangle[i]]);
        corners[static_cast<std::size_t>(i)] = glm::dvec3(toSpace * glm::dvec4(position, 1.0));
    }
    return corners;
}

// Along the normal, as long as the triangle's area.
[[nodiscard]] inline glm::dvec3 areaOf(const std::array<glm::dvec3, 3>& corners) {
    return 0.5 * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

[[nodiscard]] inline glm::dvec3 middleOf(const std::array<glm::dvec3, 3>& corners) {
    return (corners[0] + corners[1] + corners[2]) / 3.0;
}

}  // namespace kaustik::scene
