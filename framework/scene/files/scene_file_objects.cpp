// SPDX-License-Identifier: MIT
// The tables [[object]] of a scene file: mesh or shape, material and placement.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"
#include "framework/scene/files/mesh_import.h"
#include "framework/scene/files/scene_file_parts.h"

namespace kaustik::scene {
namespace {
namespace fs = std::filesystem;

// Four of the finest shapes have as many, and take a gigabyte.
constexpr std::size_t kMaxTriangles = std::size_t{1} << 25;

glm::dmat4 rotationAndScale(const ObjectKeys& keys) {
    const glm::dvec3 angles = glm::radians(keys.rotationDegrees);
    glm::dmat4 matrix(1.0);
    matrix = glm::rotate(matrix, angles.z, glm::dvec3(0.0, 0.0, 1.0));
    matrix = glm::rotate(matrix, angles.y, glm::dvec3(0.0, 1.0, 0.0));
    matrix = glm::rotate(matrix, angles.x, glm::dvec3(1.0, 0.0, 0.0));
    return glm::scale(matrix, keys.scale);
}

glm::dmat4 placeInWorld(const ObjectKeys& keys, const Scene& scene, const Object& object,
                        const TableReader& reader) {
    glm::dmat4 matrix = rotationAndScale(keys);
    glm::dvec3 anchor(0.0);  // the point that goes to `position`
    if (keys.fit || keys.restOn) {
        const Bounds bounds = objectBounds(scene, {"", object.mesh, 0, matrix});
        const glm::dvec3 extent = bounds.maximum - bounds.minimum;
        const double longest = std::max({extent.x, extent.y, extent.z});
        double factor = 1.0;
        if (keys.fit)
            factor = keys.fit->height ? *keys.fit->height / extent.y : *keys.fit->size / longest;
        if (!std::isfinite(factor)) reader.fail("fit", "the mesh has no extent to be scaled from");
        matrix = glm::scale(glm::dmat4(1.0), glm::dvec3(factor)) * matrix;
        anchor = 0.5 * factor * (bounds.minimum + bounds.maximum);
        if (keys.restOn) anchor.y = factor * bounds.minimum.y - *keys.restOn;
    }
    return glm::translate(glm::dmat4(1.0), keys.position - anchor) * matrix;
}

// What to do about a mesh that is not there: those of the papers are fetched by a command.
std::string meshHint(const std::string& mesh) {
    const auto fetch = [](const char* option) {
        return fmt::format("run experiments/fetch_meshes.sh{} to get it.", option);
    };
    if (mesh.starts_with("dragon_vrip")) return fetch(" --dragons");
    if (mesh == "teapot.obj") return fetch(" --teapot");
    for (const char* fetched : {"bunny.obj", "horse.3ds", "cat.3ds", "asteroid-high.3ds"}) {
        if (mesh == fetched) return fetch("");
    }
    return "put it there, or name its folder in KAUSTIK_MESHES (experiments/fetch_meshes.sh gets "
           "the papers' meshes).";
}

fs::path findMesh(const TableReader& reader, const fs::path& name) {
    std::vector<fs::path> folders{reader.file().parent_path(), projectRoot() / "meshes"};
    if (const char* fromEnvironment = std::getenv("KAUSTIK_MESHES")) {
        if (*fromEnvironment != '\0') folders.emplace_back(fromEnvironment);
    }
    std::vector<std::string> searched;
    for (const fs::path& folder : folders) {
        std::error_code error;
        const fs::path file = folder / name;
        if (fs::is_regular_file(file, error)) return file;
        searched.push_back(folder.empty() ? "." : folder.string());
        if (name.is_absolute()) searched = {"/"};
    }
    throw IoError(fmt::format("{}: {}: mesh '{}' was not found in {}; {}", reader.place("mesh"),
                              reader.subject(), name.string(), joinNames(searched),
                              meshHint(name.string())));
}

// The index of the mesh in the scene; a file that another object uses is read once.
std::uint32_t addMeshFile(const fs::path& file, Scene& scene, reading::ReaderProcess& process) {
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (scene.meshes[i].name == file.string()) return static_cast<std::uint32_t>(i);
    }
    ImportedMesh imported = importMeshWithWarnings(file, process);
    imported.mesh.name = file.string();
    scene.warnings.insert(scene.warnings.end(), imported.warnings.begin(), imported.warnings.end());
    scene.meshes.push_back(std::move(imported.mesh));
    return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

std::uint32_t findMaterial(const TableReader& reader, const std::string& name, const Scene& scene) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (scene.materials[i].name == name) return static_cast<std::uint32_t>(i);
        names.push_back(scene.materials[i].name);
    }
    if (names.empty()) reader.fail("material", "the file has no [[material]]");
    reader.fail("material", "material " + TableReader::notOneOf(name, names));
}

// A few lines of text must not take all of the memory.
void requireMeshLimits(const Mesh& shape, const Scene& scene, const TableReader& reader) {
    std::size_t triangles = shape.triangles.size();
    for (const Mesh& mesh : scene.meshes)
        triangles += mesh.triangles.size();
    if (triangles <= kMaxTriangles) return;
    reader.fail("shape",
                fmt::format("with this shape the scene has {} triangles, more than {}; give its "
                            "shapes fewer cells or segments",
                            triangles, kMaxTriangles));
}

}  // namespace

Object readObject(TableReader& reader, Scene& scene, reading::ReaderProcess& process) {
    const auto keys = reader.read<ObjectKeys>();
    Object object;
    object.name = keys.name;
    if (keys.isMesh) {
        const fs::path file = findMesh(reader, keys.mesh);
        object.material = findMaterial(reader, keys.material, scene);
        object.mesh = addMeshFile(file, scene, process);
    } else {
        Mesh mesh = makeShape(keys.shape, reader, scene.timeSeconds);
        mesh.name = object.name;
        object.material = findMaterial(reader, keys.material, scene);
        requireMeshLimits(mesh, scene, reader);
        scene.meshes.push_back(std::move(mesh));
        object.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
    }
    object.toWorld = placeInWorld(keys, scene, object, reader);
    return object;
}

}  // namespace kaustik::scene
