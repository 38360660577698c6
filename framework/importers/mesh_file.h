// SPDX-License-Identifier: MIT
// Mesh files, in this process: what scene::importMesh has a reader process do.
#pragma once

#include <filesystem>

#include "framework/scene/files/mesh_import.h"

namespace kaustik::scene {

// Reads the file as importMeshWithWarnings says (framework/scene/files/mesh_import.h).
[[nodiscard]] ImportedMesh readMeshFile(const std::filesystem::path& path);

}  // namespace kaustik::scene
