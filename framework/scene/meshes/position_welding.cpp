// SPDX-License-Identifier: MIT
#include "framework/scene/meshes/position_welding.h"

#include <glm/gtx/hash.hpp>
#include <unordered_map>

namespace kaustik::scene {

std::vector<std::uint32_t> weldPositions(const std::vector<glm::vec3>& positions) {
    std::unordered_map<glm::vec3, std::uint32_t> firstAt;
    firstAt.reserve(positions.size());
    std::vector<std::uint32_t> welded(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        // Adding zero turns -0 into 0: both compare equal, but not all hashes agree.
        const glm::vec3 position = positions[i] + 0.0f;
        welded[i] = firstAt.try_emplace(position, static_cast<std::uint32_t>(i)).first->second;
    }
    return welded;
}

}  // namespace kaustik::scene
