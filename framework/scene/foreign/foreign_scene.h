// SPDX-License-Identifier: MIT
// A scene of another renderer, as far as it can be said in this project's terms: what the reader
// process makes of a Mitsuba or Tungsten file, and what `kaustik import` writes as a scene file.
// Units, axes and colours are those of scene.h; shapes are unit shapes with a matrix of any kind.
// What has no counterpart is a note, so that nothing is lost without a word.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "framework/reading/reader_process.h"
#include "framework/scene/files/scene_wire.h"
#include "framework/scene/scene.h"

namespace kaustik::scene {

enum class NoteKind : std::uint32_t { leftOut, changed };

// "left out: shape 'x' (scene.xml:120): curves are not read"
struct ForeignNote {
    NoteKind kind = NoteKind::leftOut;
    std::string subject;  // shape 'x'
    std::string place;    // scene.xml:120, without a folder
    std::string reason;
};

struct ForeignImage {
    std::filesystem::path file;
    std::string place;  // of the file's name, for errors
};

struct ForeignMaterial {
    Material material;  // Material::image and normalMap are not used
    std::optional<ForeignImage> image;
    std::optional<ForeignImage> normalMap;
    bool turnsTexture = false;  // the picture stands on its head once more than the shape says
};

// In its own space a plane is a square of side 1 in the xz-plane that faces +y, a disk has radius 1
// and lies there too, a sphere has radius 1, a cylinder radius 1 and height 1 along y, without its
// ends, a box sides of 1. All are centred on the origin.
enum class ForeignGeometry : std::uint32_t { plane, disk, sphere, cylinder, box, meshFile, mesh };

// Light that leaves a surface in all directions alike.
struct ForeignEmission {
    glm::dvec3 radiance{0.0};  // W/m²/sr
    bool isPower = false;      // then `radiance` is the flux of the whole surface, W
};

struct ForeignShape {
    std::string name;
    std::string place;  // for errors
    ForeignGeometry geometry = ForeignGeometry::mesh;
    glm::dmat4 toWorld{1.0};
    std::filesystem::path file;  // meshFile
    Mesh mesh;                   // mesh
    // The picture on it stands on its head: v runs from its top to its bottom.
    bool turnsTexture = false;
    bool isInsideOut = false;  // what faces outwards faces inwards, and emits there
    std::uint32_t material = 0;
    std::optional<ForeignEmission> emission;
};

struct ForeignScene {
    std::string format;  // "Mitsuba" or "Tungsten"
    std::string name;
    std::optional<Camera> camera;
    std::uint32_t width = 0;  // of the picture, in pixels; 0: not said
    std::uint32_t height = 0;
    std::vector<Light> lights;  // Light::image is not used
    std::vector<ForeignMaterial> materials;
    std::vector<ForeignShape> shapes;
    std::optional<Medium> medium;
    glm::dvec3 backgroundRadiance{0.0};
    std::optional<ForeignImage> environment;
    double environmentTurnDegrees = 0.0;
    std::vector<ForeignNote> notes;
};

// Has a reader process read a Mitsuba .xml or a Tungsten .json. Throws ConfigError "file:line: …"
// for what the file says and IoError for a file that cannot be read.
[[nodiscard]] ForeignScene readForeignScene(const std::filesystem::path& file,
                                            reading::ReaderProcess& reader);

template <SameButConst<ForeignNote> T>
auto partsOf(T& note) {
    auto& [kind, subject, place, reason] = note;
    return std::tie(kind, subject, place, reason);
}

template <SameButConst<ForeignImage> T>
auto partsOf(T& image) {
    auto& [file, place] = image;
    return std::tie(file, place);
}

template <SameButConst<ForeignMaterial> T>
auto partsOf(T& foreign) {
    auto& [material, image, normalMap, turnsTexture] = foreign;
    return std::tie(material, image, normalMap, turnsTexture);
}

template <SameButConst<ForeignShape> T>
auto partsOf(T& shape) {
    auto& [name, place, geometry, toWorld, file, mesh, turnsTexture, isInsideOut, material,
           emission] = shape;
    return std::tie(name, place, geometry, toWorld, file, mesh, turnsTexture, isInsideOut, material,
                    emission);
}

template <SameButConst<ForeignScene> T>
auto partsOf(T& scene) {
    auto& [format, name, camera, width, height, lights, materials, shapes, medium, background,
           environment, turn, notes] = scene;
    return std::tie(format, name, camera, width, height, lights, materials, shapes, medium,
                    background, environment, turn, notes);
}

}  // namespace kaustik::scene
