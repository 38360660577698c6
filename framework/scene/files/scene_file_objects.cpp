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
constexpr std::size_t kMostTriangles = std::size_t{1} << 25;

// How the file places an object; `fit` and `rest_on` need the mesh, so this is applied later.
struct Placement {
    glm::dvec3 position{0.0};
    glm::dvec3 rotationDegrees{0.0};
    glm::dvec3 scale{1.0};
    std::optional<double> fitHeight;
    std::optional<double> fitSize;
    std::optional<double> restOn;
};

Placement readPlacement(TableReader& reader, bool isMesh) {
    Placement placement;
    placement.position = reader.vector3("position", kAnyNumber, glm::dvec3(0.0));
    placement.rotationDegrees = reader.vector3("rotation_degrees", kAnyNumber, glm::dvec3(0.0));
    placement.scale = reader.uniformOrVector3("scale", kPositive, glm::dvec3(1.0));
    if (!isMesh) return placement;
    if (reader.has("rest_on")) placement.restOn = reader.number("rest_on", kAnyNumber);
    if (std::optional<TableReader> fit = reader.table("fit")) {
        if (reader.has("scale")) reader.fail("fit", "either fit or scale is given, not both");
        if (fit->has("height") == fit->has("size")) {
            fit->finish();
            reader.fail("fit", "fit must be {height = …} or {size = …}");
        }
        if (fit->has("height")) placement.fitHeight = fit->number("height", kPositive);
        if (fit->has("size")) placement.fitSize = fit->number("size", kPositive);
        fit->finish();
    }
    return placement;
}

glm::dmat4 rotationAndScale(const Placement& placement) {
    const glm::dvec3 angles = glm::radians(placement.rotationDegrees);
    glm::dmat4 matrix(1.0);
    matrix = glm::rotate(matrix, angles.z, glm::dvec3(0.0, 0.0, 1.0));
    matrix = glm::rotate(matrix, angles.y, glm::dvec3(0.0, 1.0, 0.0));
    matrix = glm::rotate(matrix, angles.x, glm::dvec3(1.0, 0.0, 0.0));
    return glm::scale(matrix, placement.scale);
}

glm::dmat4 placeInWorld(const Placement& placement, const Scene& scene, const Object& object,
                        const TableReader& reader) {
    glm::dmat4 matrix = rotationAndScale(placement);
    glm::dvec3 anchor(0.0);  // the point that goes to `position`
    if (placement.fitHeight || placement.fitSize || placement.restOn) {
        const Bounds bounds = objectBounds(scene, {"", object.mesh, 0, matrix});
        const glm::dvec3 extent = bounds.maximum - bounds.minimum;
        const double longest = std::max({extent.x, extent.y, extent.z});
        double factor = 1.0;
        if (placement.fitHeight) factor = *placement.fitHeight / extent.y;
        if (placement.fitSize) factor = *placement.fitSize / longest;
        if (!std::isfinite(factor)) reader.fail("fit", "the mesh has no extent to be scaled from");
        matrix = glm::scale(glm::dmat4(1.0), glm::dvec3(factor)) * matrix;
        anchor = 0.5 * factor * (bounds.minimum + bounds.maximum);
        if (placement.restOn) anchor.y = factor * bounds.minimum.y - *placement.restOn;
    }
    return glm::translate(glm::dmat4(1.0), placement.position - anchor) * matrix;
}

// What to do about a mesh that is not there: those of the papers are fetched by a command.
std::string howToGet(const std::string& mesh) {
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

fs::path findMesh(TableReader& reader) {
    const fs::path name = reader.text("mesh");
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
                              howToGet(name.string())));
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

std::uint32_t findMaterial(TableReader& reader, const std::string& name, const Scene& scene) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (scene.materials[i].name == name) return static_cast<std::uint32_t>(i);
        names.push_back(scene.materials[i].name);
    }
    if (names.empty()) reader.fail("material", "the file has no [[material]]");
    reader.fail("material", "material " + TableReader::notOneOf(name, names));
}

// A few lines of text must not take all of the memory.
void requireRoom(const Mesh& shape, const Scene& scene, const TableReader& reader) {
    std::size_t triangles = shape.triangles.size();
    for (const Mesh& mesh : scene.meshes)
        triangles += mesh.triangles.size();
    if (triangles <= kMostTriangles) return;
    reader.fail("shape",
                fmt::format("with this shape the scene has {} triangles, more than {}; give its "
                            "shapes fewer cells or segments",
                            triangles, kMostTriangles));
}

}  // namespace

Object readObject(TableReader& reader, Scene& scene, reading::ReaderProcess& process) {
    Object object;
    object.name = reader.name();
    const std::string material = reader.text("material");
    const bool isMesh = reader.has("mesh");
    if (isMesh && reader.has("shape")) {
        reader.fail("shape", "either mesh or shape is given, not both");
    }
    const Placement placement = readPlacement(reader, isMesh);
    if (isMesh) {
        const fs::path file = findMesh(reader);
        reader.finish();
        object.material = findMaterial(reader, material, scene);
        object.mesh = addMeshFile(file, scene, process);
    } else {
        Mesh mesh = readShape(reader, scene.timeSeconds);
        mesh.name = object.name;
        object.material = findMaterial(reader, material, scene);
        requireRoom(mesh, scene, reader);
        scene.meshes.push_back(std::move(mesh));
        object.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
    }
    object.toWorld = placeInWorld(placement, scene, object, reader);
    return object;
}

}  // namespace kaustik::scene
