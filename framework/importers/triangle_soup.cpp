// SPDX-License-Identifier: MIT
#include "framework/importers/triangle_soup.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "framework/core/error.h"
#include "framework/scene/meshes/mesh_checks.h"
#include "framework/scene/meshes/orientation.h"
#include "framework/scene/meshes/position_welding.h"
#include "framework/scene/meshes/winding_number.h"

namespace kaustik::scene {
namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// All that tells two vertices apart.
struct VertexKey {
    std::array<float, 8> values;
    bool operator==(const VertexKey&) const = default;
};

struct VertexKeyHash {
    std::size_t operator()(const VertexKey& key) const {
        std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
        for (const float value : key.values) {
            hash = (hash ^ std::bit_cast<std::uint32_t>(value)) * 0x100000001b3u;
        }
        return static_cast<std::size_t>(hash ^ (hash >> 32));
    }
};

// The file's normal with length 1, or zero where it has to be made.
glm::vec3 validNormal(const glm::vec3& normal) {
    const glm::dvec3 wide(normal);
    const double length = glm::length(wide);
    if (!std::isfinite(length) || length == 0.0) return glm::vec3(0.0f);
    return glm::vec3(wide / length);
}

// Recentres, and joins what is identical; all triangles are kept.
Mesh joinedMesh(const TriangleSoup& soup, const std::string& where) {
    Bounds bounds;
    for (const glm::uvec3& triangle : soup.triangles) {
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            assert(triangle[corner] < soup.positions.size());
            const glm::dvec3& position = soup.positions[triangle[corner]];
            if (!isFinite(position)) {
                throw IoError(fmt::format("{}: the position of vertex {} is not finite.", where,
                                          triangle[corner]));
            }
            bounds.minimum = bounds.empty ? position : glm::min(bounds.minimum, position);
            bounds.maximum = bounds.empty ? position : glm::max(bounds.maximum, position);
            bounds.empty = false;
        }
    }
    Mesh mesh;
    mesh.origin = 0.5 * bounds.minimum + 0.5 * bounds.maximum;
    mesh.triangles.reserve(soup.triangles.size());
    std::vector<std::uint32_t> newIndex(soup.positions.size(), kUnused);
    std::unordered_map<VertexKey, std::uint32_t, VertexKeyHash> known;
    known.reserve(soup.positions.size());
    for (const glm::uvec3& triangle : soup.triangles) {
        glm::uvec3 joined(0);
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t old = triangle[corner];
            if (newIndex[old] == kUnused) {
                // Adding zero turns -0 into 0, which compare equal but have different bits.
                const auto position = glm::vec3(soup.positions[old] - mesh.origin) + 0.0f;
                const glm::vec3 normal = validNormal(soup.normals[old]) + 0.0f;
                const glm::vec2 uv = soup.uvs[old] + 0.0f;
                const VertexKey key{
                    {position.x, position.y, position.z, normal.x, normal.y, normal.z, uv.x, uv.y}};
                const auto [entry, isNew] =
                    known.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
                if (isNew) {
                    mesh.positions.push_back(position);
                    mesh.normals.push_back(normal);
                    mesh.uvs.push_back(uv);
                }
                newIndex[old] = entry->second;
            }
            joined[corner] = newIndex[old];
        }
        mesh.triangles.push_back(joined);
    }
    return mesh;
}

// Twice the area times the unit normal, in double: edges of a mesh scaled to micrometres would have
// a product below the smallest 32-bit float.
glm::dvec3 doubleAreaNormal(const Mesh& mesh, const glm::uvec3& triangle) {
    const glm::dvec3 a(mesh.positions[triangle[0]]);
    return glm::cross(glm::dvec3(mesh.positions[triangle[1]]) - a,
                      glm::dvec3(mesh.positions[triangle[2]]) - a);
}

// Exactly on a line, but for the rounding of the cross product itself.
bool isDegenerate(const Mesh& mesh, const glm::uvec3& triangle) {
    constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
    const glm::dvec3 a(mesh.positions[triangle[0]]);
    const double edges = glm::length(glm::dvec3(mesh.positions[triangle[1]]) - a) *
                         glm::length(glm::dvec3(mesh.positions[triangle[2]]) - a);
    return !(glm::length(doubleAreaNormal(mesh, triangle)) > kRounding * edges);
}

void removeUnusedVertices(Mesh& mesh) {
    std::vector<std::uint32_t> newIndex(mesh.positions.size(), kUnused);
    std::uint32_t count = 0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (glm::length_t corner = 0; corner < 3; ++corner)
            newIndex[triangle[corner]] = 0;
    }
    for (std::size_t old = 0; old < newIndex.size(); ++old) {
        if (newIndex[old] == kUnused) continue;
        mesh.positions[count] = mesh.positions[old];
        mesh.normals[count] = mesh.normals[old];
        mesh.uvs[count] = mesh.uvs[old];
        newIndex[old] = count++;
    }
    mesh.positions.resize(count);
    mesh.normals.resize(count);
    mesh.uvs.resize(count);
    for (glm::uvec3& triangle : mesh.triangles) {
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            triangle[corner] = newIndex[triangle[corner]];
        }
    }
}

// Fills in the normals that are zero; returns how many.
std::size_t makeMissingNormals(Mesh& mesh) {
    std::size_t missing = 0;
    for (const glm::vec3& normal : mesh.normals)
        missing += normal == glm::vec3(0.0f) ? 1 : 0;
    if (missing == 0) return 0;
    const std::vector<std::uint32_t> welded = weldPositions(mesh.positions);
    std::vector<glm::dvec3> sum(mesh.positions.size(), glm::dvec3(0.0));
    std::vector<glm::dvec3> anyFace(mesh.positions.size(), glm::dvec3(0.0));
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 faceNormal = glm::normalize(doubleAreaNormal(mesh, triangle));
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            const glm::dvec3 here(mesh.positions[triangle[corner]]);
            const glm::dvec3 next(mesh.positions[triangle[(corner + 1) % 3]]);
            const glm::dvec3 last(mesh.positions[triangle[(corner + 2) % 3]]);
            // atan2 stays exact where acos of the cosine would not: at slivers.
            const double angle = std::atan2(glm::length(glm::cross(next - here, last - here)),
                                            glm::dot(next - here, last - here));
            sum[welded[triangle[corner]]] += angle * faceNormal;
            anyFace[welded[triangle[corner]]] = faceNormal;
        }
    }
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        if (mesh.normals[i] != glm::vec3(0.0f)) continue;
        // Two faces back to back cancel: either will do. 1e-9 is well above the rounding of a sum
        // of angles, and well below what any fold of a real surface gives.
        const glm::dvec3 mean = sum[welded[i]];
        mesh.normals[i] =
            glm::vec3(glm::length(mean) > 1e-9 ? glm::normalize(mean) : anyFace[welded[i]]);
    }
    return missing;
}

}  // namespace

double signedVolumeTimesSix(const Mesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        sum += glm::dot(glm::dvec3(mesh.positions[triangle[0]]),
                        glm::cross(glm::dvec3(mesh.positions[triangle[1]]),
                                   glm::dvec3(mesh.positions[triangle[2]])));
    }
    return sum;
}

std::vector<std::string> BuiltMesh::oddities() const {
    std::vector<std::string> all;
    if (degenerateCount > 0)
        all.push_back(fmt::format("{} triangles without an area were dropped", degenerateCount));
    if (turnedCount > 0) {
        all.push_back(
            fmt::format("{} of {} triangles faced against their neighbours and were turned",
                        turnedCount, mesh.triangles.size()));
    }
    if (unorientableCount > 0) {
        all.push_back(
            fmt::format("{} triangles make surfaces that have one side alone, so that "
                        "neighbours face different ways",
                        unorientableCount));
    }
    if (mesh.hasInside && windingBehind < 0.5)
        all.emplace_back("the mesh is inside out (its faces are clockwise seen from outside)");
    return all;
}

BuiltMesh buildMesh(const TriangleSoup& soup, const std::string& name, const std::string& where) {
    assert(soup.normals.size() == soup.positions.size());
    assert(soup.uvs.size() == soup.positions.size());
    BuiltMesh built;
    Mesh& mesh = built.mesh;
    mesh = joinedMesh(soup, where);
    mesh.name = name;
    mesh.closed = isClosed(mesh);
    if (!mesh.closed) {
        const Orientation orientation = orientTriangles(mesh);
        built.turnedCount = orientation.turned;
        built.unorientableCount = orientation.unorientable;
        mesh.closed = isClosed(mesh);
    }
    built.degenerateCount =
        std::erase_if(mesh.triangles, [&](const auto& t) { return isDegenerate(mesh, t); });
    if (mesh.triangles.empty()) {
        throw IoError(fmt::format("{}: the mesh has no triangles{}.", where,
                                  built.degenerateCount > 0 ? " that have an area" : ""));
    }
    removeUnusedVertices(mesh);
    built.madeNormalCount = makeMissingNormals(mesh);
    validateMesh(mesh, where);
    built.windingBehind =
        mesh.closed ? (signedVolumeTimesSix(mesh) < 0.0 ? 0.0 : 1.0) : meanWindingBehind(mesh);
    mesh.hasInside = mesh.closed || boundsVolume(built.windingBehind);
    return built;
}

}  // namespace kaustik::scene
