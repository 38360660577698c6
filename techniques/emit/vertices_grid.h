// SPDX-License-Identifier: MIT
// Meshes whose vertices lie in rows and columns, and are neighbours along them.
#pragma once

#include <optional>

#include "framework/params/field.h"
#include "framework/scene/scene.h"

namespace kaustik {

// Light goes on from it, and it has triangles.
[[nodiscard]] bool isSpecular(const scene::Scene& scene, const scene::Object& object);

struct VertexGrid {
    params::Extent vertices;  // columns and rows; vertex j columns + i is the i-th of row j
    bool isTurned = false;    // triangles run from a row to the next before they run along it
};

// The grid of a mesh whose cells of four vertices are split in two triangles each, all of them the
// same way round. There is none where the mesh is no such grid.
[[nodiscard]] std::optional<VertexGrid> gridOf(const scene::Mesh& mesh);

// The grid of the scene's only specular object, where that is a sheet (scene/light_paths.h): a
// height field, or a plane in cells.
[[nodiscard]] std::optional<VertexGrid> specularGrid(const scene::Scene& scene);

}  // namespace kaustik
