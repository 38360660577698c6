// SPDX-License-Identifier: MIT
// Shapes of a foreign scene as triangles in the world, for those that no keys of a scene file say,
// and the PLY files that they become.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "framework/reading/reader_process.h"
#include "framework/scene/foreign/foreign_scene.h"

namespace kaustik::scene {

struct WorldMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;  // unit
    std::vector<glm::vec2> uvs;
    std::vector<glm::uvec3> triangles;
};

// `reader` reads mesh files. Throws as importMeshWithWarnings, and ConfigError "place: …" for a
// shape that its transform makes flat or nothing.
[[nodiscard]] WorldMesh worldMeshOf(const ForeignShape& shape, reading::ReaderProcess& reader);

// The middle of its bounds in a few digits, so that 32 bits hold what is around it.
[[nodiscard]] glm::dvec3 roundMiddle(const WorldMesh& mesh);

// Writes it as a binary PLY file, relative to `origin`.
void writePly(const std::filesystem::path& file, const WorldMesh& mesh, const glm::dvec3& origin);

}  // namespace kaustik::scene
