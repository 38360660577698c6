// SPDX-License-Identifier: MIT
// Where a caustic generator's surroundings are looked at from, and how many such points see them:
// U08, section 3, takes the middle of the object; one that is large, like water, or that stands
// around receivers, like a tank, is not seen from there. What light from it may reach is sampled by
// rays from all over its surface to the first receiver; what a point of it sees of that is what its
// map can store.
#pragma once

#include <vector>

#include "framework/scene/surface_rays.h"

namespace kaustik {

// Where light from a generator may end.
struct ReachedPlace {
    glm::dvec3 from;  // on the generator's surface
    glm::dvec3 position;
    glm::dvec3 normal;
};
// From the surfaces of all specular objects that lie in the box: points spread evenly, of sheets
// those that a light sees, rays by Lambert's cosine about the side to which it goes on, the same
// ones every time. Places in world space, m.
[[nodiscard]] std::vector<ReachedPlace> placesReached(const scene::Scene& scene,
                                                      const scene::Bounds& generator,
                                                      const scene::SurfaceRays& receivers);

// The part of a generator that is looked at from one point.
struct GeneratorPart {
    scene::Bounds bounds;
    glm::dvec3 reference{0.0};
};
struct ReferencePoints {
    std::vector<GeneratorPart> parts;
    double seenShare = 1.0;  // of the places reached from each part, by its own point
};
// In so many parts, halved along their longest sides. A part's point is the middle of its box or,
// of a sheet, which that would see edge-on, somewhat off it; where too little is seen from there,
// the best place nearby.
[[nodiscard]] ReferencePoints referencePoints(const scene::Bounds& generator,
                                              const std::vector<ReachedPlace>& reached,
                                              const scene::SurfaceRays& receivers, int pointCount);

}  // namespace kaustik
