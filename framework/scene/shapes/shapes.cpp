// SPDX-License-Identifier: MIT
// Shapes with flat faces: plane, box, prism.
#include "framework/scene/shapes/shapes.h"

#include <glm/gtc/constants.hpp>

#include "framework/scene/meshes/mesh_builder.h"
#include "framework/scene/shapes/shape_checks.h"

namespace kaustik::scene {
namespace {

// A rectangle from `corner` along two edges that are at right angles; uv in metres.
void addRectangle(MeshBuilder& builder, const glm::dvec3& corner, const glm::dvec3& edgeU,
                  const glm::dvec3& edgeV, const glm::dvec3& normal,
                  const glm::uvec2& cells = glm::uvec2(1)) {
    const glm::dvec2 meters(glm::length(edgeU), glm::length(edgeV));
    builder.addGrid(cells.x, cells.y, [&](unsigned i, unsigned j) {
        const glm::dvec2 part = glm::dvec2(i, j) / glm::dvec2(cells);
        return SurfacePoint{corner + part.x * edgeU + part.y * edgeV, normal, part * meters};
    });
}

}  // namespace

Mesh makePlane(const PlaneShape& shape) {
    requirePositive("size", shape.size.x);
    requirePositive("size", shape.size.y);
    requireCells("cells", shape.cells.x, 1);
    requireCells("cells", shape.cells.y, 1);
    MeshBuilder builder;
    addRectangle(builder, {-0.5 * shape.size.x, 0.0, -0.5 * shape.size.y}, {shape.size.x, 0.0, 0.0},
                 {0.0, 0.0, shape.size.y}, {0.0, 1.0, 0.0}, shape.cells);
    return builder.finishSheet("plane");
}

Mesh makeBox(const BoxShape& shape) {
    for (int axis = 0; axis < 3; ++axis)
        requirePositive("size", shape.size[axis]);
    bool any = false;
    MeshBuilder builder;
    for (int face = 0; face < 6; ++face) {
        if (shape.open[static_cast<std::size_t>(face)]) continue;
        any = true;
        const int axis = face / 2;
        // On walls u is horizontal and v is up.
        const int axisU = axis == 0 ? 2 : 0;
        const int axisV = axis == 1 ? 2 : 1;
        glm::dvec3 normal(0.0);
        glm::dvec3 edgeU(0.0);
        glm::dvec3 edgeV(0.0);
        normal[axis] = face % 2 == 0 ? -1.0 : 1.0;
        edgeU[axisU] = shape.size[axisU];
        edgeV[axisV] = shape.size[axisV];
        const glm::dvec3 center = 0.5 * normal * shape.size;
        addRectangle(builder, center - 0.5 * edgeU - 0.5 * edgeV, edgeU, edgeV, normal);
    }
    if (!any) throw ConfigError("open must leave at least one face of the box.");
    return builder.finish("box", shape.inward);
}

Mesh makePrism(const PrismShape& shape) {
    if (!(shape.apexDegrees > 0.0 && shape.apexDegrees < 180.0)) {
        throw ConfigError(fmt::format("apex_degrees must be from 0 to 180, both excluded, not {}.",
                                      shape.apexDegrees));
    }
    requirePositive("height", shape.height);
    requirePositive("length", shape.length);
    const double halfApex = 0.5 * glm::radians(shape.apexDegrees);
    const double top = 0.5 * shape.height;
    const double halfBase = shape.height * std::tan(halfApex);
    const double halfLength = 0.5 * shape.length;
    const glm::dvec3 along(0.0, 0.0, shape.length);
    const glm::dvec3 apex(0.0, top, -halfLength);
    const glm::dvec3 left(-halfBase, -top, -halfLength);
    const glm::dvec3 right(halfBase, -top, -halfLength);
    const double cosine = std::cos(halfApex);
    const double sine = std::sin(halfApex);

    MeshBuilder builder;
    addRectangle(builder, left, apex - left, along, {-cosine, sine, 0.0});
    addRectangle(builder, right, apex - right, along, {cosine, sine, 0.0});
    addRectangle(builder, left, right - left, along, {0.0, -1.0, 0.0});
    for (const double side : {-1.0, 1.0}) {
        const auto corner = [&](const glm::dvec3& p) {
            return SurfacePoint{
                {p.x, p.y, side * halfLength}, {0.0, 0.0, side}, {p.x + halfBase, p.y + top}};
        };
        builder.addTriangle(corner(left), corner(right), corner(apex));
    }
    return builder.finish("prism");
}

}  // namespace kaustik::scene
