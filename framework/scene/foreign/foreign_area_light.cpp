// SPDX-License-Identifier: MIT
#include "framework/scene/foreign/foreign_area_light.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "framework/core/error.h"
#include "framework/scene/foreign/foreign_meshes.h"

namespace kaustik::scene {
namespace {

constexpr double kPi = glm::pi<double>();

double areaOf(const WorldMesh& mesh) {
    double area = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3& a = mesh.positions[t.x];
        area += 0.5 * glm::length(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
    }
    return area;
}

double areaOf(const ForeignShape& shape, reading::ReaderProcess& reader) {
    // Between two directions that span it.
    const double span =
        glm::length(glm::cross(glm::dvec3(shape.toWorld[2]), glm::dvec3(shape.toWorld[0])));
    switch (shape.geometry) {
        case ForeignGeometry::plane:
            return span;
        case ForeignGeometry::disk:
            return kPi * span;
        case ForeignGeometry::sphere: {
            const double radius = std::cbrt(std::abs(glm::determinant(glm::dmat3(shape.toWorld))));
            return 4.0 * kPi * radius * radius;
        }
        default:
            return areaOf(worldMeshOf(shape, reader));
    }
}

}  // namespace

glm::dvec3 AreaLight::powerWatts() const {
    return kPi * area * radiance;
}

AreaLight areaLightOf(const ForeignShape& shape, reading::ReaderProcess& reader) {
    AreaLight light;
    light.area = areaOf(shape, reader);
    if (!(light.area > 0.0) || !std::isfinite(light.area)) {
        throw ConfigError(
            fmt::format("{}: the light '{}' has no area to shine from.", shape.place, shape.name));
    }
    light.radiance = shape.emission->radiance;
    if (shape.emission->isPower) light.radiance /= kPi * light.area;
    return light;
}

}  // namespace kaustik::scene
