// SPDX-License-Identifier: MIT
#include "framework/scene/meshes/mesh_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "framework/core/error.h"
#include "framework/scene/meshes/position_welding.h"

namespace kaustik::scene {
namespace {

// A normal that was normalised in 32 bits is off by about 1e-7; one that was stored with 8 bits a
// component by up to 0.7 %. Beyond that it was never meant to be a unit vector.
constexpr float kNormalLengthTolerance = 0.01f;

template <class Vector>
bool isFinite(const Vector& v) {
    for (glm::length_t i = 0; i < v.length(); ++i) {
        if (!std::isfinite(v[i])) return false;
    }
    return true;
}

[[noreturn]] void fail(const std::string& where, const std::string& problem) {
    throw IoError(fmt::format("{}: {}.", where, problem));
}

}  // namespace

bool isClosed(const Mesh& mesh) {
    if (mesh.triangles.empty()) return false;
    const std::vector<std::uint32_t> welded = weldPositions(mesh.positions);
    // For each edge, from its smaller to its larger vertex: passes one way minus passes the other.
    std::unordered_map<std::uint64_t, int> balance;
    balance.reserve(mesh.triangles.size() * 3 / 2);
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = welded[triangle[corner]];
            const std::uint32_t to = welded[triangle[(corner + 1) % 3]];
            if (from == to) continue;
            const std::uint64_t low = std::min(from, to);
            const std::uint64_t high = std::max(from, to);
            balance[low << 32 | high] += from < to ? 1 : -1;
        }
    }
    for (const auto& [edge, passes] : balance) {
        if (passes != 0) return false;
    }
    return !balance.empty();
}

void validateMesh(const Mesh& mesh, const std::string& where) {
    if (mesh.positions.empty() || mesh.triangles.empty()) fail(where, "the mesh has no triangles");
    if (mesh.normals.size() != mesh.positions.size() || mesh.uvs.size() != mesh.positions.size()) {
        fail(where, fmt::format("the mesh has {} positions but {} normals and {} uvs",
                                mesh.positions.size(), mesh.normals.size(), mesh.uvs.size()));
    }
    if (!isFinite(mesh.origin)) fail(where, "the mesh's origin is not finite");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (!isFinite(mesh.positions[i])) {
            fail(where, fmt::format("the position of vertex {} is not finite", i));
        }
        if (!isFinite(mesh.uvs[i]))
            fail(where, fmt::format("the uv of vertex {} is not finite", i));
        // Written so that a length that is not a number fails too.
        if (!(std::abs(glm::length(mesh.normals[i]) - 1.0f) <= kNormalLengthTolerance)) {
            fail(where, fmt::format("the normal of vertex {} does not have length 1", i));
        }
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            if (mesh.triangles[i][corner] < mesh.positions.size()) continue;
            fail(where, fmt::format("triangle {} uses vertex {}, but there are only {}", i,
                                    mesh.triangles[i][corner], mesh.positions.size()));
        }
    }
}

}  // namespace kaustik::scene
