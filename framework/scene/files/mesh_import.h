// SPDX-License-Identifier: MIT
// Triangle meshes from files: OBJ, PLY (also gzipped, .ply.gz) and 3DS. A file that is damaged, cut
// off or empty is an IoError that names it; never a mesh that is silently smaller than the file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/reading/reader_process.h"
#include "framework/scene/scene.h"

namespace kaustik::scene {

struct ImportedMesh {
    Mesh mesh;
    std::vector<std::string> warnings;  // what was changed on the way in, one sentence each
};

// All geometry of the file as one mesh, in the file's own units and axes: nodes are flattened,
// polygons triangulated, identical vertices joined, degenerate triangles dropped (with a warning).
// Mesh::origin is the centre of the bounding box. Missing normals are made smooth, weighted by the
// corner's angle over welded positions. Throws IoError naming the file and what to do.
[[nodiscard]] ImportedMesh importMeshWithWarnings(const std::filesystem::path& path,
                                                  reading::ReaderProcess& reader);

// Imports the file without its warnings, in a process for this file alone.
[[nodiscard]] Mesh importMesh(const std::filesystem::path& path);

}  // namespace kaustik::scene
