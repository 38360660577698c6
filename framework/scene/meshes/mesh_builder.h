// SPDX-License-Identifier: MIT
// What the procedural shapes are built with. Positions are in metres, in the shape's own space.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

struct SurfacePoint {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0, 1.0, 0.0};  // unit, outwards
    glm::dvec2 uv{0.0};
};

// A point of a profile in the half plane (distance from the y axis, y) and its normal there.
struct ProfilePoint {
    double radius = 0.0;
    double y = 0.0;
    glm::dvec2 normal{1.0, 0.0};
};

class MeshBuilder {
  public:
    // A patch of columns x rows quads; `point(i, j)` for i in [0, columns], j in [0, rows].
    void addGrid(unsigned columns, unsigned rows,
                 const std::function<SurfacePoint(unsigned i, unsigned j)>& point);

    // A smooth piece of a surface of revolution about the y axis, with `segments` steps around.
    // Pieces that share a profile point meet exactly. uv: metres around the widest circle, and
    // along the profile.
    void addRevolved(const std::vector<ProfilePoint>& profile, unsigned segments);

    // A single flat triangle; its normal must agree with the side that its corners show.
    void addTriangle(const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c);

    // The mesh, with `closed` found from its edges; inward: normals and triangles turned round.
    [[nodiscard]] Mesh finish(const std::string& name, bool inward = false);

    // Finishes a sheet that has a border, without a look at its edges.
    [[nodiscard]] Mesh finishSheet(const std::string& name);

  private:
    std::uint32_t addVertex(const SurfacePoint& point);
    void connect(std::uint32_t a, std::uint32_t b, std::uint32_t c);

    Mesh mesh_;
};

}  // namespace kaustik::scene
