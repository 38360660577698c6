// SPDX-License-Identifier: MIT
#include "framework/scene/files/mesh_import.h"

#include "framework/scene/files/scene_wire.h"
#include "framework/scene/meshes/mesh_checks.h"

namespace kaustik::scene {

ImportedMesh importMeshWithWarnings(const std::filesystem::path& path,
                                    reading::ReaderProcess& reader) {
    auto imported = reader.ask<ImportedMesh>({reading::RequestKind::mesh, path.string(), path, ""});
    // The reader has done so, too; but who knows what the file has done to the reader.
    validateMesh(imported.mesh, path.string());
    return imported;
}

Mesh importMesh(const std::filesystem::path& path) {
    reading::ReaderProcess reader;
    return importMeshWithWarnings(path, reader).mesh;
}

}  // namespace kaustik::scene
