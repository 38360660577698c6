// SPDX-License-Identifier: MIT
// Whether light reaches a receiver straight from its source. Every surface is in its way, specular
// ones too: what they let through is caustic light.
#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "framework/reference/embree_scene.h"

namespace kaustik::reference {

// From a point, local, straight to a light.
struct WayToLight {
    glm::dvec3 direction{0.0};  // unit
    double meters = 0.0;        // infinite for a light without a place; 0 for one that is there
};
[[nodiscard]] inline WayToLight wayTo(const scene::Light& light, const glm::dvec3& from,
                                      const glm::dvec3& sceneCenter) {
    if (light.kind == scene::LightKind::directional)
        return {-light.direction, std::numeric_limits<double>::infinity()};
    const glm::dvec3 offset = light.position - sceneCenter - from;
    const double meters = glm::length(offset);
    return {meters > 0.0 ? offset / meters : -light.direction, meters};
}

class ShadowRays {
  public:
    // A light's own surface, on which the light lies, is not in its way by rounding: as a share of
    // the way (shaders/shadow/ray_to_light.glsl).
    static constexpr double kOwnSurface = 1e-4;

    explicit ShadowRays(const EmbreeScene& scene)
        : scene_(scene),
          lift_(16.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
                glm::length(scene.bounds().maximum - scene.bounds().minimum)) {}

    // `facing`: the triangle's normal on the side from which light is asked for, unit; `toLight`:
    // unit; `meters`: to the light, infinite for one without a place.
    [[nodiscard]] bool isBlocked(const SurfaceHit& receiver, const glm::dvec3& facing,
                                 const glm::dvec3& toLight, double meters) const {
        Ray ray;
        ray.origin = receiver.position + lift_ * facing;
        ray.direction = toLight;
        ray.start = receiver.triangle;
        ray.sides = SideRule::any;
        SurfaceHit blocker;
        return scene_.intersect(ray, blocker) && blocker.distance < (1.0 - kOwnSurface) * meters;
    }

  private:
    const EmbreeScene& scene_;
    // Off the receiver, m, whose own triangle would else be in the way: positions are 32-bit
    // floats.
    double lift_;
};

}  // namespace kaustik::reference
