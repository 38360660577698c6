// SPDX-License-Identifier: MIT
// The materials and textures of a glTF file.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/importers/gltf_document.h"
#include "framework/scene/scene.h"

namespace kaustik::scene {

// glTF's lights are photometric: lux for directional ones, candela for the others. One watt of
// monochromatic light at 555 nm is 683 lumens; exporters that start from watts use that number for
// all light, and so undoing it gives their watts back.
inline constexpr double kLumensPerWatt = 683.0;

// KHR_materials_volume: light that travels attenuationDistance keeps the share `color`, so that the
// coefficient is -ln(color)/distance. Infinite distance: none. A black component: kOpaquePerMeter,
// finite, so that a path of length 0 still keeps all of the light. Both finite or infinite,
// distance > 0.
inline constexpr float kOpaquePerMeter = 1e20f;
[[nodiscard]] glm::vec3 absorptionFromAttenuation(const glm::dvec3& color, double distanceMeters);

// Appends every material of the model to `scene`, in order, and the images that they use; at the
// end one for primitives that have none. What is approximated or left out becomes a warning. Throws
// IoError that names `path` and the field when an image file is missing.
void importGltfMaterials(const tinygltf::Model& model, const std::filesystem::path& path,
                         Scene& scene);

// The uv set that the material's base colour texture uses, or else its normal texture
// (materialIndex -1: none, set 0).
[[nodiscard]] int gltfUvSet(const tinygltf::Model& model, int materialIndex);

}  // namespace kaustik::scene
