// SPDX-License-Identifier: MIT
// glTF files by tinygltf, in this process: what scene::importGltf has a reader process do.
#pragma once

#include <filesystem>

#include "framework/scene/scene.h"

namespace kaustik::scene {

// What it is read for: of a mesh nobody asks for its camera and its lamps.
enum class GltfUse { scene, mesh };

// Reads the file as importGltf says (framework/scene/files/gltf_import.h).
[[nodiscard]] Scene readGltfFile(const std::filesystem::path& path, GltfUse use = GltfUse::scene);

}  // namespace kaustik::scene
