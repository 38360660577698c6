// SPDX-License-Identifier: MIT
#include "framework/importers/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/importers/mesh_formats.h"
#include "framework/importers/triangle_soup.h"

namespace kaustik::scene {
namespace {

// The bytes of the mesh, what kind they are, and the name of the mesh.
struct MeshFile {
    std::string bytes;
    std::string extension;  // without the dot, in small letters
    std::string meshName;
};

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

MeshFile openMeshFile(const std::filesystem::path& path) {
    std::filesystem::path inner = path.filename();
    const bool zipped = lowerCase(inner.extension().string()) == ".gz";
    if (zipped) inner = inner.stem();
    MeshFile file;
    const std::string extension = lowerCase(inner.extension().string());
    if (extension != ".obj" && extension != ".ply" && extension != ".3ds") {
        throw ConfigError(
            fmt::format("{} is no mesh file that can be read: use .obj, .ply, .ply.gz "
                        "or .3ds (for .gltf and .glb, name the file as the scene).",
                        path.string()));
    }
    file.extension = extension.substr(1);
    file.meshName = inner.stem().string();
    file.bytes = readFile(path);
    if (zipped) file.bytes = gunzip(file.bytes, path.string());
    return file;
}

MeshFileContents readContents(const MeshFile& file, const std::string& name) {
    if (file.extension == "obj") return readObj(file.bytes, name);
    if (file.extension == "ply") return readPly(file.bytes, name);
    return read3ds(file.bytes, name);
}

}  // namespace

ImportedMesh readMeshFile(const std::filesystem::path& path) {
    const std::string name = path.string();
    const MeshFile file = openMeshFile(path);
    MeshFileContents contents = readContents(file, name);
    if (contents.soup.triangles.empty()) {
        throw IoError(fmt::format("{}: the file has no faces, so that it makes no mesh.", name));
    }
    BuiltMesh built = buildMesh(contents.soup, file.meshName, name);
    ImportedMesh imported{std::move(built.mesh), std::move(contents.warnings)};
    const auto warn = [&](const std::string& what) {
        imported.warnings.push_back(fmt::format("{}: {}.", name, what));
    };
    if (contents.crossingPolygons > 0) {
        warn(fmt::format("{} polygons cross themselves, so that their triangles may overlap",
                         contents.crossingPolygons));
    }
    if (built.degenerateCount > 0)
        warn(fmt::format("{} triangles without an area were dropped", built.degenerateCount));
    if (imported.mesh.closed && signedVolumeTimesSix(imported.mesh) < 0.0)
        warn("the mesh is inside out (its faces are clockwise seen from outside)");
    return imported;
}

}  // namespace kaustik::scene
