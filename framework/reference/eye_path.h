// SPDX-License-Identifier: MIT
// The path of the eye's light back through specular surfaces to the receiver that it comes from:
// the photons' own rules (light_transport.h), at each dielectric one branch with the probability of
// its share.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "framework/reference/embree_scene.h"
#include "framework/reference/light_transport.h"
#include "framework/reference/random.h"

namespace kaustik::reference {

struct EyePath {
    SurfaceHit hit;             // on the receiver
    glm::dvec3 direction{0.0};  // of the last piece, towards the receiver; unit
    // Radiance at the eye over radiance that leaves the receiver: reflectances, what media leave of
    // it, and 1/n² where the receiver lies in a medium of index n (relative to the eye's own).
    glm::dvec3 throughput{0.0};
    double lengthMeters = 0.0;
};

// A ray of the eye as a photon that goes backwards, of throughput 1. An eye that looks at a
// dielectric from within is inside of it, as a light is. Nothing where the ray hits no surface at
// all.
[[nodiscard]] std::optional<PhotonState> startAtEye(const EmbreeScene& scene,
                                                    const glm::dvec3& origin,
                                                    const glm::dvec3& direction);

// Index of refraction of a medium: material index + 1, or 0 for vacuum.
[[nodiscard]] double mediumIndex(const scene::Scene& scene, std::uint32_t medium);

// `direction`: unit. Nothing where the path leaves the scene.
[[nodiscard]] std::optional<EyePath> followEye(const EmbreeScene& scene, const glm::dvec3& origin,
                                               const glm::dvec3& direction, Random& random);

}  // namespace kaustik::reference
