// SPDX-License-Identifier: MIT
// Two directions across a third.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace kaustik::scene {

struct Basis {
    glm::dvec3 a, b;
};

// Two unit vectors at right angles to `along` and to each other; the first horizontal if possible.
[[nodiscard]] inline Basis basisAround(const glm::dvec3& along) {
    const glm::dvec3 upwards =
        std::abs(along.y) < 0.999999 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 a = glm::normalize(glm::cross(upwards, along));
    return {a, glm::cross(along, a)};
}

}  // namespace kaustik::scene
