// SPDX-License-Identifier: MIT
#include "techniques/emit/vertices_grid.h"

#include <algorithm>
#include <cstddef>

namespace kaustik {
namespace {

// Whether two triangles have the same corners, the same way round, wherever they begin.
bool isSame(const glm::uvec3& a, const glm::uvec3& b) {
    return a == b || a == glm::uvec3(b.y, b.z, b.x) || a == glm::uvec3(b.z, b.x, b.y);
}

}  // namespace

bool isSpecular(const scene::Scene& scene, const scene::Object& object) {
    return !isReceiver(scene.materials[object.material].kind) &&
           !scene.meshes[object.mesh].triangles.empty();
}

std::optional<VertexGrid> gridOf(const scene::Mesh& mesh) {
    if (mesh.triangles.empty()) return {};
    // The first triangle is 0, 1 and the vertex across, or the other way round.
    const glm::uvec3& first = mesh.triangles.front();
    const bool isTurned = first.z == 1;
    const std::uint32_t across = isTurned ? first.y : first.z;
    if (first.x != 0 || (!isTurned && first.y != 1) || across < 3) return {};
    const std::size_t columns = across - 1;
    const std::size_t rows = mesh.positions.size() / columns;
    if (rows < 2 || rows * columns != mesh.positions.size() ||
        mesh.triangles.size() != 2 * (columns - 1) * (rows - 1))
        return {};
    std::size_t next = 0;
    for (std::size_t j = 0; j + 1 < rows; ++j) {
        for (std::size_t i = 0; i + 1 < columns; ++i) {
            const auto corner = static_cast<std::uint32_t>(j * columns + i);
            const auto above = static_cast<std::uint32_t>(corner + columns);
            glm::uvec3 triangles[2] = {{corner, corner + 1, above + 1}, {corner, above + 1, above}};
            for (glm::uvec3& triangle : triangles) {
                if (isTurned) std::swap(triangle.y, triangle.z);
                if (!isSame(mesh.triangles[next++], triangle)) return {};
            }
        }
    }
    return VertexGrid{{static_cast<int>(columns), static_cast<int>(rows)}, isTurned};
}

std::optional<VertexGrid> specularGrid(const scene::Scene& scene) {
    const scene::Mesh* mesh = nullptr;
    for (const scene::Object& object : scene.objects) {
        if (!isSpecular(scene, object)) continue;
        if (mesh != nullptr) return {};
        mesh = &scene.meshes[object.mesh];
    }
    if (mesh == nullptr || mesh->hasInside) return {};
    return gridOf(*mesh);
}

}  // namespace kaustik
