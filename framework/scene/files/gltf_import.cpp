// SPDX-License-Identifier: MIT
#include "framework/scene/files/gltf_import.h"

#include <fmt/format.h>

#include "framework/core/error.h"
#include "framework/scene/emitters.h"
#include "framework/scene/files/scene_wire.h"
#include "framework/scene/meshes/mesh_checks.h"

namespace kaustik::scene {
namespace {

// What points into a list points at an entry of it.
bool isWhole(const Scene& scene) {
    const auto isImage = [&](int index) {
        return index >= -1 && index < static_cast<int>(scene.images.size());
    };
    bool whole = isImage(scene.environmentImage);
    for (const Light& light : scene.lights)
        whole = whole && isImage(light.image);
    for (const Material& material : scene.materials)
        whole = whole && isImage(material.image) && isImage(material.normalMap);
    for (const Object& object : scene.objects) {
        whole =
            whole && object.mesh < scene.meshes.size() && object.material < scene.materials.size();
    }
    return whole;
}

}  // namespace

Scene importGltf(const std::filesystem::path& path, reading::ReaderProcess& reader) {
    auto scene = reader.ask<Scene>({reading::RequestKind::gltf, path.string(), path, ""});
    // The reader has done so, too; but who knows what the file has done to the reader.
    for (const Mesh& mesh : scene.meshes)
        validateMesh(mesh, path.string());
    if (!isWhole(scene)) {
        throw IoError(
            fmt::format("{} is damaged: its parts do not fit. Export it again.", path.string()));
    }
    scene.emitters.clear();
    std::erase_if(scene.lights, [](const Light& light) { return light.emitter >= 0; });
    findEmitters(scene);
    return scene;
}

Scene importGltf(const std::filesystem::path& path) {
    reading::ReaderProcess reader;
    return importGltf(path, reader);
}

}  // namespace kaustik::scene
