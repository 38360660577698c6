// SPDX-License-Identifier: MIT
#include "framework/scene/foreign/foreign_scene.h"

#include <fmt/format.h>

#include <cmath>

#include "framework/core/error.h"
#include "framework/scene/meshes/mesh_checks.h"

namespace kaustik::scene {
namespace {

bool isFinite(const glm::dmat4& matrix) {
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            if (!std::isfinite(matrix[i][j])) return false;
        }
    }
    return true;
}

}  // namespace

ForeignScene readForeignScene(const std::filesystem::path& file, reading::ReaderProcess& reader) {
    auto scene = reader.ask<ForeignScene>({reading::RequestKind::foreign, file.string(), file, ""});
    // The reader has done so, too; but who knows what the file has done to the reader.
    for (const ForeignShape& shape : scene.shapes) {
        if (shape.geometry == ForeignGeometry::mesh) validateMesh(shape.mesh, shape.place);
        if (shape.material >= scene.materials.size() || !isFinite(shape.toWorld))
            throw IoError(fmt::format("{} is damaged: its parts do not fit.", file.string()));
    }
    return scene;
}

}  // namespace kaustik::scene
