// SPDX-License-Identifier: MIT
#include "framework/scene/foreign/foreign_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/scene/files/mesh_import.h"
#include "framework/scene/shapes/shapes.h"

namespace kaustik::scene {
namespace {

constexpr unsigned kDiskSegments = 128;

// In the xz-plane, facing +y; its uv are those of the square around it.
Mesh makeDisk() {
    Mesh mesh;
    const auto add = [&](double x, double z) {
        mesh.positions.emplace_back(x, 0.0, z);
        mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        mesh.uvs.emplace_back(0.5 + 0.5 * x, 0.5 + 0.5 * z);
    };
    add(0.0, 0.0);
    for (unsigned i = 0; i < kDiskSegments; ++i) {
        const double angle = 2.0 * glm::pi<double>() * i / kDiskSegments;
        add(std::cos(angle), std::sin(angle));
        mesh.triangles.emplace_back(0u, 1 + (i + 1) % kDiskSegments, 1 + i);
    }
    return mesh;
}

Mesh meshOf(const ForeignShape& shape, reading::ReaderProcess& reader) {
    switch (shape.geometry) {
        case ForeignGeometry::plane:
            return makePlane({});
        case ForeignGeometry::disk:
            return makeDisk();
        case ForeignGeometry::sphere: {
            SphereShape sphere;
            sphere.radius = 1.0;
            return makeSphere(sphere);
        }
        case ForeignGeometry::cylinder: {
            CylinderShape cylinder;
            cylinder.radius = 1.0;
            cylinder.open = true;
            return makeCylinder(cylinder);
        }
        case ForeignGeometry::box:
            return makeBox({});
        case ForeignGeometry::meshFile:
            return importMeshWithWarnings(shape.file, reader).mesh;
        case ForeignGeometry::mesh:
            break;
    }
    return shape.mesh;
}

void append(std::string& bytes, const void* value, std::size_t size) {
    bytes.append(static_cast<const char*>(value), size);
}

}  // namespace

WorldMesh worldMeshOf(const ForeignShape& shape, reading::ReaderProcess& reader) {
    const Mesh mesh = meshOf(shape, reader);
    const glm::dmat3 linear(shape.toWorld);
    const double determinant = glm::determinant(linear);
    if (!(std::abs(determinant) > 0.0))
        throw ConfigError(
            fmt::format("{}: its transform leaves the shape no extent.", shape.place));
    const glm::dmat3 toNormal = glm::transpose(glm::inverse(linear));
    WorldMesh world;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 position = mesh.origin + glm::dvec3(mesh.positions[i]);
        world.positions.emplace_back(shape.toWorld * glm::dvec4(position, 1.0));
        const glm::dvec3 normal = toNormal * glm::dvec3(mesh.normals[i]);
        const double length = glm::length(normal);
        world.normals.emplace_back(length > 0.0 ? normal / length : glm::dvec3(0.0, 1.0, 0.0));
        const glm::vec2 uv = mesh.uvs[i];
        world.uvs.emplace_back(uv.x, shape.turnsTexture ? 1.0f - uv.y : uv.y);
    }
    for (const glm::uvec3& t : mesh.triangles)
        world.triangles.push_back(determinant < 0.0 ? glm::uvec3(t.x, t.z, t.y) : t);
    return world;
}

glm::dvec3 roundMiddle(const WorldMesh& mesh) {
    if (mesh.positions.empty()) return glm::dvec3(0.0);
    glm::dvec3 low = mesh.positions[0];
    glm::dvec3 high = low;
    for (const glm::dvec3& position : mesh.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    const glm::dvec3 extent = high - low;
    const double longest = std::max({extent.x, extent.y, extent.z, 1e-12});
    const double step = std::pow(10.0, std::floor(std::log10(longest)) - 1.0);
    return glm::round(0.5 * (low + high) / step) * step;
}

void writePly(const std::filesystem::path& file, const WorldMesh& mesh, const glm::dvec3& origin) {
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
        "property float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\n"
        "property float u\nproperty float v\n"
        "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        mesh.positions.size(), mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 position(mesh.positions[i] - origin);
        append(bytes, &position, sizeof(position));
        append(bytes, &mesh.normals[i], sizeof(glm::vec3));
        append(bytes, &mesh.uvs[i], sizeof(glm::vec2));
    }
    for (const glm::uvec3& triangle : mesh.triangles) {
        bytes += '\3';
        append(bytes, &triangle, sizeof(triangle));
    }
    writeFileWhole(file, bytes);
}

}  // namespace kaustik::scene
