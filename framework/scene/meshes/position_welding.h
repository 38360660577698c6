// SPDX-License-Identifier: MIT
// Finds vertices of a mesh that lie at exactly the same position.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace kaustik::scene {

// The index of the first equal position, for each position. The comparison is exact, so that it
// does not depend on the size of the mesh; -0 equals 0.
[[nodiscard]] std::vector<std::uint32_t> weldPositions(const std::vector<glm::vec3>& positions);

}  // namespace kaustik::scene
