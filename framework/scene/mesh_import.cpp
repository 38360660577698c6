// SPDX-License-Identifier: MIT
#include "framework/scene/mesh_import.h"

#include "framework/reading/reader_process.h"
#include "framework/scene/mesh_checks.h"
#include "framework/scene/scene_wire.h"

namespace kaustik::scene {

ImportedMesh importMeshWithWarnings(const std::filesystem::path& path) {
    using reading::RequestKind;
    auto imported =
        reading::readInOwnProcess<ImportedMesh>({RequestKind::mesh, path.string(), path, ""});
    // The reader has done so, too; but who knows what the file has done to the reader.
    validateMesh(imported.mesh, path.string());
    return imported;
}

Mesh importMesh(const std::filesystem::path& path) {
    return importMeshWithWarnings(path).mesh;
}

}  // namespace kaustik::scene
