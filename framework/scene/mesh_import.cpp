// SPDX-License-Identifier: MIT
#include "framework/scene/mesh_import.h"

#include "framework/scene/mesh_checks.h"
#include "framework/scene/scene_wire.h"

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
