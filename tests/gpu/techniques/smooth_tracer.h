// SPDX-License-Identifier: MIT
// Light through smooth shapes in closed form, in double precision: what photons and their beams are
// judged by. No meshes, no shading normals, nothing of the renderer's own. World space, m.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace kaustik::test {

struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0};  // unit
};

enum class Optics { receiver, glass, mirror };

// One smooth surface. `distance`: m along a ray to where it is first hit beyond 1e-7 m; `normal`:
// unit, outward, of a point on it.
struct SmoothSurface {
    std::function<std::optional<double>(const Ray&)> distance;
    std::function<glm::dvec3(const glm::dvec3&)> normal;
    Optics optics = Optics::receiver;
    double index = 1.0;  // of refraction, behind it
};

using SmoothScene = std::vector<SmoothSurface>;

// All surfaces of these shapes, as framework/scene/shapes/shapes.h describes them.
[[nodiscard]] SmoothScene smoothFloor(double height);
[[nodiscard]] SmoothScene smoothBall(const glm::dvec3& center, double radius, double index);
struct SmoothLens {
    glm::dvec3 center{0.0};
    double topRadius = 1.0;  // convex
    double bottomRadius = 1.0;
    double diameter = 1.0;
    double thickness = 0.2;  // at the middle
};
[[nodiscard]] SmoothScene smoothLens(const SmoothLens& lens, double index);
[[nodiscard]] SmoothScene smoothCylinder(const glm::dvec3& center, double radius, double height,
                                         double index);
[[nodiscard]] SmoothScene smoothRing(const glm::dvec3& center, double innerRadius,
                                     double outerRadius, double height);
struct SmoothWave {
    double amplitude = 0.0;
    double wavelength = 1.0;
    double directionDegrees = 0.0;
};
// y = the sum of A cos(k · (x, z)), over a square around the origin.
[[nodiscard]] SmoothScene smoothWaves(const std::vector<SmoothWave>& waves, double side,
                                      double index);

// Where a ray meets a surface, and as what it goes on.
struct SmoothHit {
    std::size_t surface = 0;
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};
    double cosine = 0.0;  // the smaller one of those at which light comes and goes on, at least 0
    Ray next;
};

// The hits of a ray up to the receiver, or as many as there are. `reflected`: whether the ray goes
// on reflected at each of its interactions; where it cannot go on that way, or hits nothing, it
// ends.
[[nodiscard]] std::vector<SmoothHit> followPath(const SmoothScene& scene, Ray ray,
                                                const std::vector<bool>& reflected);

}  // namespace kaustik::test
