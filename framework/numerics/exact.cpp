// SPDX-License-Identifier: MIT
#include "framework/numerics/exact.h"

#include <algorithm>
#include <cmath>

namespace kaustik::numerics {

ExactInterface exactInterface(const glm::dvec3& direction, const glm::dvec3& normal, double from,
                              double to) {
    ExactInterface result;
    const double cosI = -glm::dot(direction, normal);
    result.reflected = direction + 2.0 * cosI * normal;
    // The part of the direction along the surface grows with the index that is left.
    const glm::dvec3 along = (direction + cosI * normal) * (from / to);
    const double sin2 = glm::dot(along, along);
    if (sin2 >= 1.0) return result;
    const double cosT = std::sqrt(1.0 - sin2);
    result.refracted = along - cosT * normal;
    const double s = (from * cosI - to * cosT) / (from * cosI + to * cosT);
    const double p = (to * cosI - from * cosT) / (to * cosI + from * cosT);
    result.reflectance = 0.5 * (s * s + p * p);
    return result;
}

namespace {

// A corner of a mesh in the world.
glm::dvec3 cornerOf(const scene::Mesh& mesh, const scene::Object& object, std::uint32_t i) {
    return glm::dvec3(object.toWorld *
                      glm::dvec4(mesh.origin + glm::dvec3(mesh.positions[i]), 1.0));
}

}  // namespace

std::optional<double> firstCrossing(const scene::Scene& scene, const scene::Object& object,
                                    const glm::dvec3& origin, const glm::dvec3& direction,
                                    bool leaves, double minimum) {
    const scene::Mesh& mesh = scene.meshes[object.mesh];
    std::optional<double> nearest;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = cornerOf(mesh, object, t.x);
        const glm::dvec3 ab = cornerOf(mesh, object, t.y) - a;
        const glm::dvec3 ac = cornerOf(mesh, object, t.z) - a;
        const glm::dvec3 area = glm::cross(ab, ac);
        const double closing = glm::dot(direction, area);
        if (closing == 0.0 || (closing > 0.0) != leaves) continue;
        const glm::dvec3 toA = a - origin;
        const glm::dvec3 across = glm::cross(direction, toA);
        const double u = -glm::dot(ac, across) / closing;
        const double v = glm::dot(ab, across) / closing;
        const double distance = glm::dot(toA, area) / closing;
        // A ray through the seam of two triangles belongs to both.
        if (u < -1e-9 || v < -1e-9 || u + v > 1.0 + 1e-9 || distance < minimum) continue;
        if (!nearest || distance < *nearest) nearest = distance;
    }
    return nearest;
}

std::optional<SurfacePoint> surfaceAt(const scene::Scene& scene, const scene::Object& object,
                                      const glm::dvec3& point) {
    const scene::Mesh& mesh = scene.meshes[object.mesh];
    const glm::dmat3 toWorld = glm::transpose(glm::inverse(glm::dmat3(object.toWorld)));
    std::optional<SurfacePoint> found;
    double nearest = 1e300;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = cornerOf(mesh, object, t.x);
        const glm::dvec3 ab = cornerOf(mesh, object, t.y) - a;
        const glm::dvec3 ac = cornerOf(mesh, object, t.z) - a;
        const glm::dvec3 area = glm::cross(ab, ac);
        const double area2 = glm::dot(area, area);
        if (area2 <= 0.0) continue;
        const glm::dvec3 offset = point - a;
        const double v = glm::dot(glm::cross(offset, ac), area) / area2;
        const double w = glm::dot(glm::cross(ab, offset), area) / area2;
        const double u = 1.0 - v - w;
        const double edge = std::min({u, v, w});
        const double height = std::abs(glm::dot(offset, area)) / std::sqrt(area2);
        if (edge < -1e-4 || height >= nearest) continue;
        nearest = height;
        SurfacePoint surface;
        surface.edgeDistance = edge;
        surface.triangleNormal = area / std::sqrt(area2);
        surface.shadingNormal = glm::normalize(toWorld * (u * glm::dvec3(mesh.normals[t.x]) +
                                                          v * glm::dvec3(mesh.normals[t.y]) +
                                                          w * glm::dvec3(mesh.normals[t.z])));
        found = surface;
    }
    return found;
}

}  // namespace kaustik::numerics
