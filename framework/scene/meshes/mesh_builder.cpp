// SPDX-License-Identifier: MIT
#include "framework/scene/meshes/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "framework/scene/meshes/mesh_checks.h"
#include "framework/scene/meshes/winding_number.h"

namespace kaustik::scene {

std::uint32_t MeshBuilder::addVertex(const SurfacePoint& point) {
    mesh_.positions.emplace_back(point.position);
    mesh_.normals.emplace_back(point.normal);
    mesh_.uvs.emplace_back(point.uv);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

// Turns the triangle counter-clockwise as seen from the side that its normals point to, and leaves
// it out where two corners fall together, as at a pole.
void MeshBuilder::connect(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& p = mesh_.positions;
    if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;
    const glm::dvec3 face = glm::cross(glm::dvec3(p[b]) - glm::dvec3(p[a]),  //
                                       glm::dvec3(p[c]) - glm::dvec3(p[a]));
    const glm::dvec3 outward =
        glm::dvec3(mesh_.normals[a]) + glm::dvec3(mesh_.normals[b]) + glm::dvec3(mesh_.normals[c]);
    if (glm::dot(face, outward) < 0.0) std::swap(b, c);
    mesh_.triangles.emplace_back(a, b, c);
}

void MeshBuilder::addGrid(unsigned columns, unsigned rows,
                          const std::function<SurfacePoint(unsigned, unsigned)>& point) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (unsigned j = 0; j <= rows; ++j) {
        for (unsigned i = 0; i <= columns; ++i)
            addVertex(point(i, j));
    }
    for (unsigned j = 0; j < rows; ++j) {
        for (unsigned i = 0; i < columns; ++i) {
            const std::uint32_t corner = first + j * (columns + 1) + i;
            connect(corner, corner + 1, corner + columns + 2);
            connect(corner, corner + columns + 2, corner + columns + 1);
        }
    }
}

void MeshBuilder::addRevolved(const std::vector<ProfilePoint>& profile, unsigned segments) {
    double widest = 0.0;
    std::vector<double> along(profile.size(), 0.0);
    for (std::size_t j = 0; j < profile.size(); ++j) {
        widest = std::max(widest, profile[j].radius);
        if (j == 0) continue;
        along[j] = along[j - 1] + std::hypot(profile[j].radius - profile[j - 1].radius,
                                             profile[j].y - profile[j - 1].y);
    }
    addGrid(segments, static_cast<unsigned>(profile.size() - 1), [&](unsigned i, unsigned j) {
        // The last column is the first again, to the bit, so that the seam closes.
        const double angle = glm::two_pi<double>() * (i % segments) / segments;
        const double cosine = std::cos(angle);
        const double sine = std::sin(angle);
        const ProfilePoint& p = profile[j];
        return SurfacePoint{{p.radius * cosine, p.y, p.radius * sine},
                            {p.normal.x * cosine, p.normal.y, p.normal.x * sine},
                            {glm::two_pi<double>() * i / segments * widest, along[j]}};
    });
}

void MeshBuilder::addTriangle(const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c) {
    const std::uint32_t first = addVertex(a);
    addVertex(b);
    addVertex(c);
    connect(first, first + 1, first + 2);
}

Mesh MeshBuilder::finishSheet(const std::string& name) {
    mesh_.name = name;
    mesh_.closed = false;
    mesh_.hasInside = false;
    return std::move(mesh_);
}

Mesh MeshBuilder::finish(const std::string& name, bool inward) {
    mesh_.name = name;
    if (inward) {
        for (glm::vec3& normal : mesh_.normals)
            normal = -normal;
        for (glm::uvec3& triangle : mesh_.triangles)
            std::swap(triangle.y, triangle.z);
    }
    mesh_.closed = isClosed(mesh_);
    mesh_.hasInside = mesh_.closed || boundsVolume(meanWindingBehind(mesh_));
    return std::move(mesh_);
}

}  // namespace kaustik::scene
