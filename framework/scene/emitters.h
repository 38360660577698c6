// SPDX-License-Identifier: MIT
// Lights that have a size: the disc of a directional light, surfaces of a material that emits, and
// the environment (emitting_environment.h).
// What renders lights from points, stands a number of points of each in its place
// (Scene::lights, with Light::emitter), by low discrepancy; the reference samples the whole.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

// The triangles of an emitting object, in the world.
class EmittingSurface {
  public:
    EmittingSurface(const Scene& scene, const Object& object);

    [[nodiscard]] double areaSquareMeters() const {
        return cumulated_.empty() ? 0.0 : cumulated_.back();
    }
    // Whether it faces one way on the whole, as a panel, and not all ways, as a bulb.
    [[nodiscard]] bool isLevel() const;
    struct Point {
        glm::dvec3 position{0.0};
        glm::dvec3 normal{0.0};  // unit: the side that it shines to
    };
    // Evenly by area; all numbers in [0, 1): which triangle, and where in it.
    [[nodiscard]] Point at(double which, double u, double v) const;
    // The middles of parts of equal area that are as compact as halving along the longest side
    // makes them, on the surface, with their mean normals: next to each other, not at random.
    [[nodiscard]] std::vector<Point> middles(int parts) const;

  private:
    using Corners = std::array<glm::dvec3, 3>;
    using Range = std::pair<Corners*, Corners*>;
    static void addMiddles(Range range, int parts, std::vector<Point>& all);

    std::vector<Corners> triangles_;
    std::vector<double> cumulated_;  // areas, m²
};

// Moves directional lights that have a disc from `lights` to `emitters`, makes one of each object
// of a material that emits, and puts points for a picture of usual size in their place. To be
// called when the scene's parts are there, and again when objects were added or left out.
void findEmitters(Scene& scene);

// How many points stand for an emitter, and why.
struct EmitterPoints {
    int points = 1;
    // By how much it spreads light from one point of a specular surface, at most, and what a pixel
    // sees there, m.
    double blurMeters = 0.0;
    double pixelMeters = 0.0;
};
// `wanted`: 0 says that it is to be found out: as many, up to 16, as are some pixels apart in what
// they do to light, in a picture of so many rows; so that a light whose size is hardly seen is one
// point and costs nothing. Of a body that shines to all sides one point within would be hidden by
// it: it has 16; an environment has 64.
[[nodiscard]] EmitterPoints pointsOf(const Scene& scene, const Emitter& emitter, int wanted,
                                     int rows);

// Puts the points of all emitters in the place of those that are there; the scene has no bands
// then.
void placeLightPoints(Scene& scene, int wanted, int rows);

// How many points the emitter with the most has; 1 where all lights are points of their own.
[[nodiscard]] int mostLightPoints(const Scene& scene);

// "sun", or the object's name.
[[nodiscard]] std::string nameOf(const Scene& scene, const Emitter& emitter);

}  // namespace kaustik::scene
