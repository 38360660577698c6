// SPDX-License-Identifier: MIT
// What every mesh must satisfy before anything else sees it, wherever it came from.
#pragma once

#include <string>

#include "framework/scene/scene.h"

namespace kaustik::scene {

// True when the faces bound a volume: along every edge, as many triangles run one way as the other
// (two in all, on an ordinary mesh). Corners at exactly the same position count as one vertex, so
// that a seam in the normals or uvs does not open the mesh.
[[nodiscard]] bool isClosed(const Mesh& mesh);

// Throws IoError that begins with `where` (a file or an object) unless `mesh` has a triangle, one
// normal and one uv a position, all numbers finite, all indices in range and normals of length 1.
void validateMesh(const Mesh& mesh, const std::string& where);

}  // namespace kaustik::scene
