// SPDX-License-Identifier: MIT
#include "framework/scene/files/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/names.h"
#include "framework/scene/emitters.h"
#include "framework/scene/files/gltf_import.h"
#include "framework/scene/files/own_mesh.h"
#include "framework/scene/files/scene_file_parts.h"

namespace kaustik::scene {
namespace {
namespace fs = std::filesystem;

template <class Named>
void requireNewName(const std::vector<Named>& others, const std::string& name,
                    const TableReader& reader) {
    for (const Named& other : others) {
        if (other.name == name) reader.fail("name", "this name is used twice; names are unique");
    }
}

fs::path sceneFolder() {
    return projectRoot() / "experiments" / "scenes";
}

// Of a scene that does not say its name.
std::string nameOf(const fs::path& path) {
    return path.has_stem() ? path.stem().string() : "scene";
}

// A file that says `extends`: only what it changes is in it.
Scene loadExtension(TableReader& top, const fs::path& path) {
    ExtensionKeys keys = top.read<ExtensionKeys>();
    const std::string& base = keys.extends;
    const SceneEdits edits = makeEdits(std::move(keys.edits));
    // A scene that extends itself, by whatever way, would be loaded for ever.
    static thread_local int depth = 0;
    struct Deeper {
        Deeper() { ++depth; }
        ~Deeper() { --depth; }
    } const deeper;
    if (depth > 16) top.fail("extends", "scenes extend each other without an end");
    Scene scene;
    try {
        scene = loadScene(isSceneFile(base) ? (path.parent_path() / base).string() : base);
    } catch (const ConfigError& error) {
        top.fail("extends", error.what());
    }
    scene.name = keys.name.value_or(nameOf(path));
    if (!keys.description.empty()) scene.description = keys.description;
    scene.extendedFiles.insert(scene.extendedFiles.begin(), scene.file);
    scene.file = path;
    try {
        applyEdits(scene, edits);
    } catch (const ConfigError& error) {
        top.fail("extends", error.what());
    }
    return scene;
}

// What nothing lights would be a black picture.
Scene loadGltf(const std::string& path) {
    Scene scene = importGltf(path);
    if (!scene.lights.empty() || scene.objects.empty()) return scene;
    Scene stood = loadOwnMesh({.file = path});
    stood.warnings.insert(
        stood.warnings.begin(),
        fmt::format("{}: the file has no light, so that it is stood on a table under the sun; --on "
                    "says where else.",
                    path));
    return stood;
}

}  // namespace

std::vector<fs::path> sceneFilesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const fs::path file = entry.path();
        if (file.extension() == ".toml" && !file.filename().string().starts_with('.'))
            files.push_back(file);
    }
    std::sort(files.begin(), files.end(),
              [](const fs::path& a, const fs::path& b) { return a.stem() < b.stem(); });
    return files;
}

std::string lowerExtension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return extension;
}

Scene loadSceneFile(const fs::path& path) {
    // One process for the scene and its meshes; each file has all of the time.
    reading::ReaderProcess process;
    return makeScene(readToml(path, process), path, process);
}

Scene makeScene(const TomlNode& document, const fs::path& path, reading::ReaderProcess& process) {
    TableReader top(document, path, "");
    if (top.has("extends")) return loadExtension(top, path);
    Scene scene;
    scene.file = path;
    // Before the tables in it: a misspelt [[materials]] is not a missing material.
    SceneKeys keys = top.read<SceneKeys>();
    scene.name = keys.name.value_or(nameOf(path));
    scene.description = keys.description;
    scene.backgroundRadiance = keys.backgroundRadiance;
    scene.ambientIrradiance = keys.ambientIrradiance;
    scene.timeSeconds = keys.timeSeconds;
    if (keys.camera.reader) scene.camera = readCamera(*keys.camera.reader);
    if (keys.medium.reader) scene.medium = keys.medium.reader->read<Medium>();
    if (keys.environment.reader) readEnvironment(*keys.environment.reader, scene);
    for (TableReader& reader : keys.lights.readers) {
        Light light = readLight(reader, scene);
        requireNewName(scene.lights, light.name, reader);
        scene.lights.push_back(std::move(light));
    }
    for (TableReader& reader : keys.materials.readers) {
        Material material = readMaterial(reader, scene);
        requireNewName(scene.materials, material.name, reader);
        scene.materials.push_back(std::move(material));
    }
    for (TableReader& reader : keys.objects.readers) {
        Object object = readObject(reader, scene, process);
        requireNewName(scene.objects, object.name, reader);
        scene.objects.push_back(std::move(object));
    }
    findEmitters(scene);
    return scene;
}

bool isSceneFile(const fs::path& path) {
    if (parseOwnMesh(path.string())) return true;
    const std::string extension = lowerExtension(path);
    return extension == ".toml" || extension == ".gltf" || extension == ".glb";
}

Scene loadScene(const std::string& nameOrPath) {
    if (const std::optional<OwnMesh> own = parseOwnMesh(nameOrPath)) return loadOwnMesh(*own);
    if (isSceneFile(nameOrPath)) {
        return lowerExtension(nameOrPath) == ".toml" ? loadSceneFile(nameOrPath)
                                                     : loadGltf(nameOrPath);
    }
    std::vector<std::string> names;
    for (const fs::path& file : sceneFilesIn(sceneFolder())) {
        names.push_back(file.stem().string());
        if (names.back() == nameOrPath) return loadSceneFile(file);
    }
    if (names.empty()) {
        throw ConfigError(fmt::format("There is no scene '{}': {} has no scene files.", nameOrPath,
                                      sceneFolder().string()));
    }
    const std::string suggestion = didYouMean(nameOrPath, names);
    throw ConfigError(fmt::format(
        "There is no scene '{}'{} The scenes are {}; a path to a .toml, .gltf or .glb file will do "
        "as well, and a mesh, which is stood on a table (--on).",
        nameOrPath, suggestion.empty() ? "." : suggestion, joinNames(names)));
}

std::vector<SceneListing> listScenes() {
    std::vector<SceneListing> listings;
    reading::ReaderProcess reader;
    for (const fs::path& file : sceneFilesIn(sceneFolder())) {
        SceneListing listing{file.stem().string(), "", file};
        try {
            const TomlNode document = readToml(file, reader);
            const TomlNode* const found = document.find("description");
            const auto* const text = found != nullptr ? found->as<std::string>() : nullptr;
            if (text != nullptr) listing.description = *text;
        } catch (const Error& problem) {
            listing.description = problem.what();
        }
        listings.push_back(std::move(listing));
    }
    return listings;
}

}  // namespace kaustik::scene
