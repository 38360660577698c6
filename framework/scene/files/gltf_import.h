// SPDX-License-Identifier: MIT
// Scenes from glTF 2.0 files (.gltf and .glb), with KHR_lights_punctual,
// KHR_materials_transmission, KHR_materials_ior and KHR_materials_volume. Images stay encoded in
// Scene::images.
#pragma once

#include <filesystem>

#include "framework/reading/reader_process.h"
#include "framework/scene/scene.h"

namespace kaustik::scene {

// Reads and validates the default scene of the file. Throws ConfigError where a value makes no
// sense (an IOR below 1, a transmission of 7) and IoError where the file is damaged (cut off, an
// accessor out of range, a missing buffer); both name the file and the JSON field. What was left
// out or approximated is in Scene::warnings.
[[nodiscard]] Scene importGltf(const std::filesystem::path& path, reading::ReaderProcess& reader);

// Imports the file in a process for this file alone.
[[nodiscard]] Scene importGltf(const std::filesystem::path& path);

}  // namespace kaustik::scene
