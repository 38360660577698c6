// SPDX-License-Identifier: MIT
// The hierarchy over all triangles of a scene (transport/bvh.h) on the device, in "local" space:
// the world's, in metres, less the middle of the scene, so that 32-bit floats lose nothing far from
// the world's origin. Whoever traces it includes include/surfaces/bvh.glsl.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "framework/gl/objects.h"
#include "framework/scene/bvh.h"
#include "framework/scene/scene.h"

namespace kaustik::render {

class SceneBvh {
  public:
    // Height fields lie as they do at Scene::timeSeconds. ConfigError where the device takes no
    // block of so many triangles.
    explicit SceneBvh(const scene::Scene& scene);

    [[nodiscard]] const gl::Buffer& nodes() const { return nodes_; }      // BvhNode
    [[nodiscard]] const gl::Buffer& corners() const { return corners_; }  // VertexData, three each
    [[nodiscard]] const gl::Buffer& sources() const { return sources_; }  // BvhSource
    [[nodiscard]] std::size_t nodeCount() const { return nodeCount_; }
    [[nodiscard]] std::size_t triangleCount() const { return triangleCount_; }
    [[nodiscard]] const std::vector<scene::Bvh::Level>& levels() const { return levels_; }
    [[nodiscard]] std::size_t stackSize() const { return stackSize_; }
    // That local coordinates may be off by after a few operations in 32 bits, m.
    [[nodiscard]] float roundingMeters() const { return roundingMeters_; }
    // Whether there are height fields, whose corners and bounds are to be made anew.
    [[nodiscard]] bool isMoving() const { return isMoving_; }
    [[nodiscard]] glm::dmat4 worldToLocal() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    glm::dvec3 center_{0.0};  // m
    gl::Buffer nodes_;
    gl::Buffer corners_;
    gl::Buffer sources_;
    std::size_t nodeCount_ = 0;
    std::size_t triangleCount_ = 0;
    std::vector<scene::Bvh::Level> levels_;
    std::size_t stackSize_ = 0;
    float roundingMeters_ = 0.0f;
    bool isMoving_ = false;
};

}  // namespace kaustik::render
