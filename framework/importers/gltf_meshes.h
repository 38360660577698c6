// SPDX-License-Identifier: MIT
// The triangles of a glTF file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/importers/gltf_document.h"
#include "framework/scene/scene.h"

namespace kaustik::scene {

// One primitive as a mesh in the space of its node, or none where it holds points or lines; then,
// and where triangles were dropped, a warning is added. `uvSet` picks TEXCOORD_0 or another. A
// mirrored mesh is reflected in the plane x = 0, triangles turned round: what a node with a
// negative determinant needs, whose own transform is then times the same reflection. Throws IoError
// that names `file` and the field where an accessor is out of range or of a wrong type, or the mesh
// is not valid.
[[nodiscard]] std::optional<Mesh> importGltfPrimitive(const tinygltf::Model& model,
                                                      std::size_t meshIndex,
                                                      std::size_t primitiveIndex, int uvSet,
                                                      bool mirrored, const std::string& file,
                                                      std::vector<std::string>& warnings);

}  // namespace kaustik::scene
