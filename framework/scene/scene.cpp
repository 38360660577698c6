// SPDX-License-Identifier: MIT
#include "framework/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kaustik::scene {
namespace {

// The box that a height field stays in at every time: no wave rises above the sum of amplitudes.
Bounds heightFieldBounds(const HeightField& field) {
    double amplitude = 0.0;
    for (const Wave& wave : field.waves)
        amplitude += std::abs(double(wave.amplitudeMeters));
    const glm::dvec2 half = 0.5 * glm::dvec2(field.sizeMeters);
    Bounds bounds;
    bounds.include({-half.x, -amplitude, -half.y});
    bounds.include({half.x, amplitude, half.y});
    return bounds;
}

}  // namespace

void Bounds::include(const glm::dvec3& point) {
    minimum = empty ? point : glm::min(minimum, point);
    maximum = empty ? point : glm::max(maximum, point);
    empty = false;
}

bool overlap(const Bounds& a, const Bounds& b) {
    return !a.empty && !b.empty && glm::all(glm::lessThan(a.minimum, b.maximum)) &&
           glm::all(glm::lessThan(b.minimum, a.maximum));
}

Bounds objectBounds(const Scene& scene, const Object& object) {
    const Mesh& mesh = scene.meshes[object.mesh];
    const auto toWorld = [&](const glm::dvec3& position) {
        return glm::dvec3(object.toWorld * glm::dvec4(mesh.origin + position, 1.0));
    };
    Bounds bounds;
    if (mesh.heightField) {
        const Bounds local = heightFieldBounds(*mesh.heightField);
        for (int corner = 0; corner < 8; ++corner) {
            bounds.include(toWorld({(corner & 1) ? local.maximum.x : local.minimum.x,
                                    (corner & 2) ? local.maximum.y : local.minimum.y,
                                    (corner & 4) ? local.maximum.z : local.minimum.z}));
        }
        return bounds;
    }
    for (const glm::vec3& position : mesh.positions)
        bounds.include(toWorld(position));
    return bounds;
}

Bounds sceneBounds(const Scene& scene) {
    Bounds bounds;
    for (const Object& object : scene.objects) {
        const Bounds part = objectBounds(scene, object);
        if (part.empty) continue;
        bounds.include(part.minimum);
        bounds.include(part.maximum);
    }
    return bounds;
}

Bounds specularBounds(const Scene& scene) {
    Bounds bounds;
    for (const Object& object : scene.objects) {
        if (isReceiver(scene.materials[object.material].kind)) continue;
        const Bounds part = objectBounds(scene, object);
        if (part.empty) continue;
        bounds.include(part.minimum);
        bounds.include(part.maximum);
    }
    return bounds;
}

std::size_t triangleCount(const Scene& scene) {
    std::size_t count = 0;
    for (const Object& object : scene.objects)
        count += scene.meshes[object.mesh].triangles.size();
    return count;
}

std::optional<glm::dvec3> topOfImage(const glm::dvec3& direction, const glm::dvec3& wanted) {
    const glm::dvec3 up = wanted - glm::dot(wanted, direction) * direction;
    if (!(glm::length(up) >= 1e-6)) return std::nullopt;
    return glm::normalize(up);
}

glm::dvec3 defaultTopOfImage(const glm::dvec3& direction) {
    const bool isVertical = std::abs(direction.y) > 1.0 - 1e-9;
    return isVertical ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
}

bool hasNormalMaps(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& material) { return material.normalMap >= 0; });
}

double spotFalloff(const Light& light, double cosine) {
    const double inner = std::cos(double(light.innerConeRadians));
    const double outer = std::cos(double(light.outerConeRadians));
    if (cosine >= inner) return 1.0;
    if (cosine <= outer) return 0.0;
    const double ramp = (cosine - outer) / (inner - outer);
    return ramp * ramp;
}

glm::dvec2 spotImagePosition(const Light& light, const glm::dvec3& direction) {
    const double edge = std::tan(double(light.outerConeRadians));
    const double along = glm::dot(direction, light.direction) * edge;
    const glm::dvec3 right = glm::cross(light.direction, light.up);
    return 0.5 +
           0.5 * glm::dvec2(glm::dot(direction, right), glm::dot(direction, light.up)) / along;
}

}  // namespace kaustik::scene
