// SPDX-License-Identifier: MIT
// Optics and triangles in plain double precision, written for the cases alone: nothing here is
// shared with what they measure.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "framework/scene/scene.h"

namespace kaustik::numerics {

struct ExactInterface {
    double reflectance = 1.0;
    glm::dvec3 reflected{0.0};
    glm::dvec3 refracted{0.0};  // zero for total internal reflection
};
// Fresnel's equations and Snell's law in vectors; `normal` on the side that the light comes from.
[[nodiscard]] ExactInterface exactInterface(const glm::dvec3& direction, const glm::dvec3& normal,
                                            double from, double to);

// The triangle of an object that a point of its surface belongs to.
struct SurfacePoint {
    glm::dvec3 triangleNormal{0.0};  // unit, by the winding
    glm::dvec3 shadingNormal{0.0};   // interpolated, unit, never on the other side
    double edgeDistance = 0.0;  // least barycentric coordinate: near 0 the triangle is in doubt
};
// The one whose plane is nearest among those that hold the point; none where none does.
[[nodiscard]] std::optional<SurfacePoint> surfaceAt(const scene::Scene& scene,
                                                    const scene::Object& object,
                                                    const glm::dvec3& point);

// Distance along a ray to an object's first triangle that it hits from within (it leaves there) or
// from outside; none where it hits none. Starts count from `minimum` on, m.
[[nodiscard]] std::optional<double> firstCrossing(const scene::Scene& scene,
                                                  const scene::Object& object,
                                                  const glm::dvec3& origin,
                                                  const glm::dvec3& direction, bool leaves,
                                                  double minimum);

}  // namespace kaustik::numerics
