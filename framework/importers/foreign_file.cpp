// SPDX-License-Identifier: MIT
#include "framework/importers/foreign_file.h"

#include <fmt/format.h>

#include "framework/core/error.h"
#include "framework/scene/files/scene_file_parts.h"

namespace kaustik::scene {

ForeignScene readForeignFile(const std::filesystem::path& file) {
    const std::string extension = lowerExtension(file);
    if (extension != ".xml" && extension != ".json") {
        throw ConfigError(fmt::format(
            "{} cannot be imported: it takes scenes of Mitsuba (.xml) and Tungsten (.json).",
            file.string()));
    }
    ForeignScene scene = extension == ".xml" ? readMitsuba(file) : readTungsten(file);
    scene.name = file.stem().string();
    if (scene.name == "scene" && file.has_parent_path()) {
        // Most scenes of both renderers are called that; their folder has the name.
        const std::string folder = std::filesystem::absolute(file).parent_path().filename();
        if (!folder.empty()) scene.name = folder;
    }
    return scene;
}

ImportedMesh buildForeignMesh(const TriangleSoup& soup, const std::string& name) {
    if (soup.triangles.empty()) throw IoError(fmt::format("{}: the mesh has no faces.", name));
    const std::filesystem::path file(name);
    BuiltMesh built = buildMesh(soup, file.stem().string(), name);
    ImportedMesh imported;
    for (const std::string& oddity : built.oddities())
        imported.warnings.push_back(fmt::format("{}: {}", file.filename().string(), oddity));
    imported.mesh = std::move(built.mesh);
    return imported;
}

}  // namespace kaustik::scene
