// SPDX-License-Identifier: MIT
#include "framework/importers/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/importers/gltf_file.h"
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
    if (extension != ".obj" && extension != ".ply" && extension != ".stl" && extension != ".3ds") {
        throw ConfigError(
            fmt::format("{} is no mesh file that can be read: use .obj, .ply, .ply.gz, .stl, .3ds, "
                        ".gltf or .glb.",
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
    if (file.extension == "stl") return readStl(file.bytes, name);
    return read3ds(file.bytes, name);
}

bool isGltf(const std::filesystem::path& path) {
    const std::string extension = lowerCase(path.extension().string());
    return extension == ".gltf" || extension == ".glb";
}

// All objects of the scene, where they stand; what else is in it is left out.
MeshFileContents contentsOf(const Scene& scene) {
    MeshFileContents contents;
    contents.warnings = scene.warnings;
    TriangleSoup& soup = contents.soup;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.meshes[object.mesh];
        const glm::dmat3 linear(object.toWorld);
        const double turns = glm::determinant(linear);
        // Scaled to nothing in some direction, it has no normals.
        const glm::dmat3 normals =
            turns != 0.0 ? glm::transpose(glm::inverse(linear)) : glm::dmat3(0.0);
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::dvec3 place = mesh.origin + glm::dvec3(mesh.positions[i]);
            soup.positions.emplace_back(object.toWorld * glm::dvec4(place, 1.0));
            soup.normals.emplace_back(normals * glm::dvec3(mesh.normals[i]));
            soup.uvs.push_back(mesh.uvs[i]);
        }
        for (const glm::uvec3& t : mesh.triangles)
            soup.triangles.push_back((turns < 0.0 ? glm::uvec3(t.x, t.z, t.y) : t) + first);
    }
    return contents;
}

ImportedMesh meshOf(const MeshFileContents& contents, const std::string& meshName,
                    const std::string& name) {
    if (contents.soup.triangles.empty()) {
        throw IoError(fmt::format("{}: the file has no faces, so that it makes no mesh.", name));
    }
    BuiltMesh built = buildMesh(contents.soup, meshName, name);
    ImportedMesh imported{{}, contents.warnings};
    const auto warn = [&](const std::string& what) {
        imported.warnings.push_back(fmt::format("{}: {}.", name, what));
    };
    if (contents.crossingPolygons > 0) {
        warn(fmt::format("{} polygons cross themselves, so that their triangles may overlap",
                         contents.crossingPolygons));
    }
    for (const std::string& oddity : built.oddities())
        warn(oddity);
    imported.mesh = std::move(built.mesh);
    return imported;
}

}  // namespace

ImportedMesh readMeshFile(const std::filesystem::path& path) {
    const std::string name = path.string();
    if (isGltf(path)) {
        const MeshFileContents contents = contentsOf(readGltfFile(path, GltfUse::mesh));
        return meshOf(contents, path.stem().string(), name);
    }
    const MeshFile file = openMeshFile(path);
    return meshOf(readContents(file, name), file.meshName, name);
}

}  // namespace kaustik::scene
