// SPDX-License-Identifier: MIT
// The exact first hits of photons that somebody else has traced: what the photon audit compares a
// tracer with. The same side rule as shaders/include/surfaces/side_rule.glsl (`isFacing`).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "framework/reference/embree_scene.h"
#include "framework/scene/dielectrics.h"

namespace kaustik::reference {

// A photon that has left its last specular surface, as the transfer map holds it.
struct AuditPhoton {
    glm::dvec3 position{0.0};   // m, in the space of `toWorld`
    glm::dvec3 direction{0.0};  // any length but 0
    std::uint32_t media = 0;    // as transport::Photon::media
    // How far from an open mirror that it has left it may start, m: what a pixel resolves there.
    double reachMeters = 0.0;
};

struct FirstHit {
    double distanceMeters = 0.0;    // 0: the photon hits nothing
    glm::dvec3 position{0.0};       // in the space of the photons
    glm::dvec3 shadingNormal{0.0};  // unit, outward, in the space of the photons
    glm::dvec3 geometricNormal{0.0};
    std::uint32_t material = 0;  // index + 1; 0: none
    TriangleId triangle;
    [[nodiscard]] bool exists() const { return material != 0; }
};

// Finds them one by one, from any number of threads. `toWorld`: a rigid motion, the identity for
// photons in world space or the inverse of RasterView::worldToView for those of the GPU. The scene
// must outlive this.
class FirstHits {
  public:
    explicit FirstHits(const EmbreeScene& scene, const glm::dmat4& toWorld = glm::dmat4(1.0));
    // A photon that is no number hits nothing.
    [[nodiscard]] FirstHit of(const AuditPhoton& photon) const;
    // How the shading normal turns with the position at a hit that exists, 1/m, in the space of the
    // photons (EmbreeScene::normalTurning).
    [[nodiscard]] glm::dmat3 turningAt(const FirstHit& hit) const;

  private:
    const EmbreeScene& scene_;
    scene::Dielectrics dielectrics_;
    glm::dmat3 rotation_;
    glm::dvec3 offset_;  // to the scene's local space
};

// One hit a photon, in their order; the same at any number of threads (0: all).
[[nodiscard]] std::vector<FirstHit> exactFirstHits(const EmbreeScene& scene,
                                                   std::span<const AuditPhoton> photons,
                                                   const glm::dmat4& toWorld = glm::dmat4(1.0),
                                                   int threads = 0);

}  // namespace kaustik::reference
