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
// Of a flat light's size: how far in front of it its point light is, so that a wall in its plane
// does not cut the light in half.
constexpr double kInFront = 1e-3;

glm::dvec3 place(const ForeignShape& shape, double x, double z) {
    return glm::dvec3(shape.toWorld * glm::dvec4(x, 0.0, z, 1.0));
}

// A plane or disk between two directions that span its area.
void setFlat(const ForeignShape& shape, AreaLight& light, double areaOfUnit) {
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(shape.toWorld[2]), glm::dvec3(shape.toWorld[0]));
    const double span = glm::length(normal);
    light.area = areaOfUnit * span;
    if (span > 0.0) light.normal = (shape.isInsideOut ? -normal : normal) / span;
}

void setFromTriangles(const WorldMesh& mesh, AreaLight& light) {
    glm::dvec3 weighted(0.0);
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3& a = mesh.positions[t.x];
        const glm::dvec3& b = mesh.positions[t.y];
        const glm::dvec3& c = mesh.positions[t.z];
        const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
        light.area += area;
        weighted += area * (a + b + c) / 3.0;
    }
    if (light.area > 0.0) light.center = weighted / light.area;
}

}  // namespace

glm::dvec3 AreaLight::powerWatts() const {
    return kPi * area * radiance;
}

AreaLight areaLightOf(const ForeignShape& shape, reading::ReaderProcess& reader) {
    AreaLight light;
    light.name = shape.name;
    light.center = place(shape, 0.0, 0.0);
    if (shape.geometry == ForeignGeometry::plane) {
        light.kind = AreaLightKind::rectangle;
        light.corners = {place(shape, -0.5, -0.5), place(shape, -0.5, 0.5), place(shape, 0.5, 0.5),
                         place(shape, 0.5, -0.5)};
        setFlat(shape, light, 1.0);
    } else if (shape.geometry == ForeignGeometry::disk) {
        light.kind = AreaLightKind::disc;
        setFlat(shape, light, kPi);
        light.radius = std::sqrt(light.area / kPi);
    } else if (shape.geometry == ForeignGeometry::sphere) {
        light.kind = AreaLightKind::sphere;
        light.radius = std::cbrt(std::abs(glm::determinant(glm::dmat3(shape.toWorld))));
        light.area = 4.0 * kPi * light.radius * light.radius;
    } else {
        light.kind = AreaLightKind::mesh;
        setFromTriangles(worldMeshOf(shape, reader), light);
    }
    if (!(light.area > 0.0) || !std::isfinite(light.area)) {
        throw ConfigError(
            fmt::format("{}: the light '{}' has no area to shine from.", shape.place, shape.name));
    }
    light.radiance = shape.emission->radiance;
    if (shape.emission->isPower) light.radiance /= kPi * light.area;
    return light;
}

Light pointLightFor(const AreaLight& light) {
    const bool isFlat = light.kind == AreaLightKind::rectangle || light.kind == AreaLightKind::disc;
    Light point;
    point.name = light.name;
    point.kind = LightKind::point;
    point.position = light.center;
    if (isFlat) point.position += kInFront * std::sqrt(light.area) * light.normal;
    point.power =
        glm::vec3(isFlat ? light.area * light.radiance : light.powerWatts() / (4.0 * kPi));
    return point;
}

}  // namespace kaustik::scene
