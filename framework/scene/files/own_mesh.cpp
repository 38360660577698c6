// SPDX-License-Identifier: MIT
#include "framework/scene/files/own_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"
#include "framework/scene/emitters.h"
#include "framework/scene/files/gltf_import.h"
#include "framework/scene/files/scene_file.h"
#include "framework/scene/files/scene_file_parts.h"

namespace kaustik::scene {
namespace {
namespace fs = std::filesystem;

constexpr const char* kPlaceholder = "own";  // as `mesh` of the object that stands for it

fs::path standFolder() {
    return projectRoot() / "experiments" / "scenes" / "on";
}

bool isGltf(const std::string& path) {
    const std::string extension = lowerExtension(path);
    return extension == ".gltf" || extension == ".glb";
}

fs::path standFile(const std::string& on) {
    if (lowerExtension(on) == ".toml") return on;
    const std::vector<std::string> stands = listStands();
    if (std::find(stands.begin(), stands.end(), on) == stands.end()) {
        const std::string suggestion = didYouMean(on, stands);
        throw ConfigError(fmt::format(
            "--on: there is no '{}'{} It takes {}, or a .toml file with "
            "an object whose mesh is \"{}\".",
            on, suggestion.empty() ? "." : suggestion, joinNames(stands), kPlaceholder));
    }
    return standFolder() / (on + ".toml");
}

TomlNode* entryOf(TomlTable& table, const char* key) {
    for (TomlEntry& entry : table.entries) {
        if (entry.key == key) return &entry.node;
    }
    return nullptr;
}

void set(TomlTable& table, const char* key, TomlNode value) {
    if (TomlNode* const found = entryOf(table, key)) {
        value.line = found->line;
        value.column = found->column;
        *found = std::move(value);
        return;
    }
    const auto place = std::find_if(table.entries.begin(), table.entries.end(),
                                    [&](const TomlEntry& entry) { return entry.key > key; });
    table.entries.insert(place, {key, std::move(value)});
}

// The object that stands for the mesh; null: the scene is not made for one.
TomlTable* placeholderOf(TomlNode& document) {
    auto* const top = std::get_if<TomlTable>(&document.value);
    TomlNode* const objects = top != nullptr ? entryOf(*top, "object") : nullptr;
    auto* const list = objects != nullptr ? std::get_if<TomlList>(&objects->value) : nullptr;
    if (list == nullptr) return nullptr;
    for (TomlNode& element : list->elements) {
        auto* const object = std::get_if<TomlTable>(&element.value);
        const TomlNode* const mesh = object != nullptr ? entryOf(*object, "mesh") : nullptr;
        const auto* const text = mesh != nullptr ? mesh->as<std::string>() : nullptr;
        if (text != nullptr && *text == kPlaceholder) return object;
    }
    return nullptr;
}

TomlNode textNode(const std::string& text) {
    return {text, 0, 0};
}

// About x by a quarter turn less than the scene says, so that z comes to point up.
TomlNode turnedUp(const TomlNode* degrees) {
    std::array<double, 3> angles{};
    if (degrees != nullptr && degrees->list() != nullptr && degrees->list()->size() == 3) {
        for (std::size_t i = 0; i < 3; ++i) {
            const TomlNode& angle = (*degrees->list())[i];
            if (const auto* const whole = angle.as<std::int64_t>())
                angles[i] = static_cast<double>(*whole);
            if (const auto* const real = angle.as<double>()) angles[i] = *real;
        }
    }
    angles[0] -= 90.0;
    TomlList list;
    for (const double angle : angles)
        list.elements.push_back({angle, 0, 0});
    return {std::move(list), 0, 0};
}

bool isSpecularAnywhere(const Scene& scene) {
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
        return !isReceiver(scene.materials[object.material].kind);
    });
}

// Objects of their own in the place of one that has all their triangles.
void putParts(Scene& scene, std::size_t placeholder, Scene own) {
    const Object whole = scene.objects[placeholder];
    scene.objects.erase(scene.objects.begin() + static_cast<std::ptrdiff_t>(placeholder));
    scene.meshes.erase(scene.meshes.begin() + static_cast<std::ptrdiff_t>(whole.mesh));
    for (Object& object : scene.objects)
        object.mesh -= object.mesh > whole.mesh ? 1 : 0;
    const auto firstMesh = static_cast<std::uint32_t>(scene.meshes.size());
    const auto firstMaterial = static_cast<std::uint32_t>(scene.materials.size());
    const auto firstImage = static_cast<int>(scene.images.size());
    std::move(own.meshes.begin(), own.meshes.end(), std::back_inserter(scene.meshes));
    std::move(own.images.begin(), own.images.end(), std::back_inserter(scene.images));
    for (Material& material : own.materials) {
        if (material.image >= 0) material.image += firstImage;
        if (material.normalMap >= 0) material.normalMap += firstImage;
        scene.materials.push_back(std::move(material));
    }
    for (Object& object : own.objects) {
        scene.objects.push_back({fmt::format("{}: {}", whole.name, object.name),
                                 firstMesh + object.mesh, firstMaterial + object.material,
                                 whole.toWorld * object.toWorld});
    }
}

}  // namespace

bool isMeshFile(const std::string& path) {
    const std::string extension = lowerExtension(path);
    if (extension == ".gz") return lowerExtension(fs::path(path).stem()) == ".ply";
    return extension == ".obj" || extension == ".ply" || extension == ".stl" || extension == ".3ds";
}

std::optional<OwnMesh> parseOwnMesh(const std::string& name) {
    OwnMesh mesh;
    const std::size_t query = name.rfind("?on=");
    mesh.file = name.substr(0, query);
    if (query == std::string::npos) {
        if (!isMeshFile(name)) return std::nullopt;
        return mesh;
    }
    std::string rest = name.substr(query + 1);
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('&'), rest.size());
        const std::string option = rest.substr(0, end);
        rest.erase(0, end + 1);
        const std::size_t equals = std::min(option.find('='), option.size());
        const std::string key = option.substr(0, equals);
        const std::string value = equals < option.size() ? option.substr(equals + 1) : "";
        if (key == "on") {
            mesh.on = value;
        } else if (key == "material") {
            mesh.material = value;
        } else if (key == "up" && (value == "y" || value == "z")) {
            mesh.up = value;
        } else {
            throw ConfigError(
                fmt::format("{}: '{}' is none of on=NAME, material=NAME, up=y and "
                            "up=z.",
                            name, option));
        }
    }
    return mesh;
}

std::string nameOf(const OwnMesh& mesh) {
    std::string name = fmt::format("{}?on={}", mesh.file, mesh.on);
    if (!mesh.material.empty()) name += "&material=" + mesh.material;
    if (mesh.up != "y") name += "&up=" + mesh.up;
    return name;
}

Scene loadOwnMesh(const OwnMesh& mesh) {
    const bool isGltfFile = isGltf(mesh.file);
    if (!isGltfFile && !isMeshFile(mesh.file)) {
        throw ConfigError(
            fmt::format("--on: {} is no mesh; it takes a .obj, .ply, .ply.gz, .stl, "
                        ".3ds, .gltf or .glb file.",
                        mesh.file));
    }
    std::error_code error;
    if (!fs::is_regular_file(mesh.file, error))
        throw IoError(fmt::format("{} cannot be read: there is no such file.", mesh.file));
    const fs::path stand = standFile(mesh.on);
    reading::ReaderProcess process;
    TomlNode document = readToml(stand, process);
    TomlTable* const placeholder = placeholderOf(document);
    if (placeholder == nullptr) {
        throw ConfigError(
            fmt::format("--on: {} has no object whose mesh is \"{}\", in the place of "
                        "which yours would be.",
                        stand.string(), kPlaceholder));
    }
    set(*placeholder, "mesh", textNode(fs::absolute(mesh.file).string()));
    if (!mesh.material.empty()) set(*placeholder, "material", textNode(mesh.material));
    if (mesh.up == "z")
        set(*placeholder, "rotation_degrees", turnedUp(entryOf(*placeholder, "rotation_degrees")));
    const TomlNode* const called = entryOf(*placeholder, "name");
    const std::string objectName =
        called != nullptr && called->as<std::string>() ? *called->as<std::string>() : "";
    Scene scene = makeScene(document, stand, process);
    scene.name = fmt::format("{}-on-{}", fs::path(mesh.file).stem().stem().string(), scene.name);
    if (!isGltfFile || !mesh.material.empty()) return scene;
    Scene own = importGltf(mesh.file, process);
    if (!isSpecularAnywhere(own)) {
        scene.warnings.push_back(
            fmt::format("{}: none of its materials refracts or mirrors, so "
                        "that it is of the material of {} (--material).",
                        mesh.file, stand.filename().string()));
        return scene;
    }
    const auto found =
        std::find_if(scene.objects.begin(), scene.objects.end(),
                     [&](const Object& object) { return object.name == objectName; });
    if (found == scene.objects.end())
        throw ConfigError(fmt::format("{}: the object for the mesh needs a name.", stand.string()));
    putParts(scene, static_cast<std::size_t>(found - scene.objects.begin()), std::move(own));
    findEmitters(scene);
    return scene;
}

std::vector<std::string> listStands() {
    std::vector<std::string> names;
    for (const fs::path& file : sceneFilesIn(standFolder()))
        names.push_back(file.stem().string());
    return names;
}

}  // namespace kaustik::scene
