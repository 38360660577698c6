// SPDX-License-Identifier: MIT
// The first surface on a ray, on the processor: for what is decided about a scene before a frame of
// it is made. A tree of boxes over the triangles of those objects that are asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

// Objects of receivers, by their places in the scene.
[[nodiscard]] std::vector<std::size_t> receiversOf(const Scene& scene);

class SurfaceRays {
  public:
    SurfaceRays(const Scene& scene, const std::vector<std::size_t>& objects);

    // World space, m; the normal is of the triangle, unit, and points to either side.
    struct Hit {
        double distance = 0.0;
        glm::dvec3 position{0.0};
        glm::dvec3 normal{0.0};
        std::size_t object = 0;  // its place in the scene
    };
    // `direction`: unit. Nothing where there is no surface.
    [[nodiscard]] std::optional<Hit> first(const glm::dvec3& origin,
                                           const glm::dvec3& direction) const;
    // Whether any surface is nearer than `farthest`.
    [[nodiscard]] bool isBlocked(const glm::dvec3& origin, const glm::dvec3& direction,
                                 double farthest = std::numeric_limits<double>::infinity()) const;

  private:
    struct Triangle {
        glm::dvec3 corner;
        glm::dvec3 edges[2];  // to the other corners
        std::size_t object = 0;
    };
    struct Node {
        glm::dvec3 minimum;
        glm::dvec3 maximum;
        std::uint32_t first = 0;  // of a leaf its first triangle, else its second child
        std::uint32_t count = 0;  // of a leaf's triangles; 0: the first child is the next node
    };
    void addNode(std::size_t begin, std::size_t end);
    [[nodiscard]] std::optional<std::size_t> hit(const glm::dvec3& origin,
                                                 const glm::dvec3& direction, double& farthest,
                                                 bool isAnyEnough) const;

    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
};

}  // namespace kaustik::scene
