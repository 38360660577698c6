// SPDX-License-Identifier: MIT
// Shapes with round faces: sphere, cylinder, ring, torus.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "framework/scene/meshes/mesh_builder.h"
#include "framework/scene/shapes/shape_checks.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene {
namespace {

constexpr glm::dvec2 kOutwards{1.0, 0.0};
constexpr glm::dvec2 kInwards{-1.0, 0.0};
constexpr glm::dvec2 kUp{0.0, 1.0};
constexpr glm::dvec2 kDown{0.0, -1.0};

// One sixth of the sphere: the points of a cube's face on `axis`, spaced by equal angles.
void addSphereFace(MeshBuilder& builder, int axis, double side, double radius, unsigned cells) {
    // Odd in its argument and 1 at the end, to the bit: neighbouring faces meet exactly.
    const auto warp = [&](unsigned step) {
        const double t = (2.0 * step - cells) / cells;
        return std::abs(t) == 1.0 ? t : std::tan(0.25 * glm::pi<double>() * t);
    };
    builder.addGrid(cells, cells, [&](unsigned i, unsigned j) {
        glm::dvec3 onCube(0.0);
        onCube[axis] = side;
        onCube[(axis + 1) % 3] = warp(i);
        onCube[(axis + 2) % 3] = warp(j);
        const glm::dvec3 normal = glm::normalize(onCube);
        const double step = 0.5 * glm::pi<double>() * radius / cells;
        return SurfacePoint{radius * normal, normal, step * glm::dvec2(i, j)};
    });
}

}  // namespace

Mesh makeSphere(const SphereShape& shape) {
    requirePositive("radius", shape.radius);
    requireCells("segments", shape.segments, 4);
    const unsigned cells = (shape.segments + 3) / 4;
    MeshBuilder builder;
    for (int axis = 0; axis < 3; ++axis) {
        addSphereFace(builder, axis, -1.0, shape.radius, cells);
        addSphereFace(builder, axis, 1.0, shape.radius, cells);
    }
    return builder.finish("sphere");
}

Mesh makeCylinder(const CylinderShape& shape) {
    requirePositive("radius", shape.radius);
    requirePositive("height", shape.height);
    requireCells("segments", shape.segments, 3);
    const double r = shape.radius;
    const double top = 0.5 * shape.height;
    MeshBuilder builder;
    builder.addRevolved({{r, -top, kOutwards}, {r, top, kOutwards}}, shape.segments);
    if (!shape.open) {
        builder.addRevolved({{r, top, kUp}, {0.0, top, kUp}}, shape.segments);
        builder.addRevolved({{0.0, -top, kDown}, {r, -top, kDown}}, shape.segments);
    }
    return builder.finish("cylinder", shape.inward);
}

Mesh makeDisc(const DiscShape& shape) {
    requirePositive("radius", shape.radius);
    requireCells("segments", shape.segments, 3);
    MeshBuilder builder;
    builder.addRevolved({{shape.radius, 0.0, kUp}, {0.0, 0.0, kUp}}, shape.segments);
    return builder.finishSheet("disc");
}

Mesh makeRing(const RingShape& shape) {
    requirePositive("inner_radius", shape.innerRadius);
    requirePositive("outer_radius", shape.outerRadius);
    requirePositive("height", shape.height);
    requireCells("segments", shape.segments, 3);
    if (shape.innerRadius >= shape.outerRadius) {
        throw ConfigError(fmt::format("inner_radius must be less than outer_radius ({}), not {}.",
                                      shape.outerRadius, shape.innerRadius));
    }
    const double inner = shape.innerRadius;
    const double outer = shape.outerRadius;
    const double top = 0.5 * shape.height;
    MeshBuilder builder;
    builder.addRevolved({{outer, -top, kOutwards}, {outer, top, kOutwards}}, shape.segments);
    builder.addRevolved({{outer, top, kUp}, {inner, top, kUp}}, shape.segments);
    builder.addRevolved({{inner, top, kInwards}, {inner, -top, kInwards}}, shape.segments);
    builder.addRevolved({{inner, -top, kDown}, {outer, -top, kDown}}, shape.segments);
    return builder.finish("ring");
}

Mesh makeTorus(const TorusShape& shape) {
    requirePositive("radius", shape.radius);
    requirePositive("tube_radius", shape.tubeRadius);
    requireCells("segments", shape.segments, 3);
    requireCells("tube_segments", shape.tubeSegments, 3);
    if (shape.tubeRadius >= shape.radius) {
        throw ConfigError(fmt::format("tube_radius must be less than radius ({}), not {}.",
                                      shape.radius, shape.tubeRadius));
    }
    std::vector<ProfilePoint> profile;
    for (unsigned j = 0; j <= shape.tubeSegments; ++j) {
        const double angle = glm::two_pi<double>() * (j % shape.tubeSegments) / shape.tubeSegments;
        const glm::dvec2 normal(std::cos(angle), std::sin(angle));
        profile.push_back(
            {shape.radius + shape.tubeRadius * normal.x, shape.tubeRadius * normal.y, normal});
    }
    MeshBuilder builder;
    builder.addRevolved(profile, shape.segments);
    return builder.finish("torus");
}

}  // namespace kaustik::scene
