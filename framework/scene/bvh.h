// SPDX-License-Identifier: MIT
// Builds the bounding volume hierarchy of transport/bvh.h: binary by the surface area heuristic
// over bins (Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies"), then four
// children a node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "framework/transport/bvh.h"

namespace kaustik::scene {

struct BoxBounds {
    glm::vec3 lower{3.4e38f};
    glm::vec3 upper{-3.4e38f};
    void include(const glm::vec3& point) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    void include(const BoxBounds& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
};

struct Bvh {
    // The root first; a level of the tree after the other, the nodes of each side by side.
    std::vector<transport::BvhNode> nodes;
    struct Level {
        std::size_t first;
        std::size_t count;
    };
    std::vector<Level> levels;
    std::vector<std::uint32_t> order;  // what leaves count: numbers of what was given
    // The most children that a traversal which visits one child of a node first keeps for later.
    [[nodiscard]] std::size_t stackSize() const {
        return (transport::kBvhWidth - 1) * levels.size() + 1;
    }
};

// Over things with these bounds, m. Without any: a root of no children.
[[nodiscard]] Bvh buildBvh(std::span<const BoxBounds> bounds);

}  // namespace kaustik::scene
