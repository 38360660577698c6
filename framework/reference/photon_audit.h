// SPDX-License-Identifier: MIT
// The exact first hits of photons that somebody else has traced: what the photon audit compares a
// tracer with. The same side rule as shaders/include/surfaces/side_rule.glsl (`isFacing`).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "framework/reference/embree_scene.h"

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
    glm::dmat3 turning{0.0};     // of the shading normal with the position, 1/m
    std::uint32_t material = 0;  // index + 1; 0: none
    TriangleId triangle;
    [[nodiscard]] bool exists() const { return material != 0; }
};

// One hit a photon, in their order; the same at any number of threads (0: all). `toWorld`: a rigid
// motion, the identity for photons in world space or the inverse of RasterView::worldToView for
// those of the GPU. A photon that is no number hits nothing.
[[nodiscard]] std::vector<FirstHit> exactFirstHits(const EmbreeScene& scene,
                                                   std::span<const AuditPhoton> photons,
                                                   const glm::dmat4& toWorld = glm::dmat4(1.0),
                                                   int threads = 0);

}  // namespace kaustik::reference
