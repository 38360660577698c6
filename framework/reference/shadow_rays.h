// SPDX-License-Identifier: MIT
// Whether light reaches a receiver straight from its source. Every surface is in its way, specular
// ones too: what they let through is caustic light.
#pragma once

#include <limits>

#include "framework/reference/embree_scene.h"

namespace kaustik::reference {

class ShadowRays {
  public:
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
    // A light's own surface, on which the light lies, is not in its way by rounding: as a share of
    // the way.
    static constexpr double kOwnSurface = 1e-4;

    const EmbreeScene& scene_;
    // Off the receiver, m, whose own triangle would else be in the way: positions are 32-bit
    // floats.
    double lift_;
};

}  // namespace kaustik::reference
