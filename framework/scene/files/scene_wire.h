// SPDX-License-Identifier: MIT
// The parts of a scene that a reader process sends. Each is tied whole: a member that is added to
// a struct of scene.h and not here does not compile. Structs of plain numbers travel as they are.
#pragma once

#include <tuple>
#include <type_traits>

#include "framework/reading/wire.h"
#include "framework/scene/files/mesh_import.h"
#include "framework/scene/scene.h"

namespace kaustik::scene {

template <class T, class Wanted>
concept SameButConst = std::is_same_v<std::remove_const_t<T>, Wanted>;

template <SameButConst<Light> T>
auto partsOf(T& light) {
    auto& [name, kind, position, direction, power, inner, outer, range, image, up, diameter,
           emitter, band, radius] = light;
    return std::tie(name, kind, position, direction, power, inner, outer, range, image, up,
                    diameter, emitter, band, radius);
}

template <SameButConst<Material> T>
auto partsOf(T& material) {
    auto& [name, kind, albedo, pattern, patternAlbedo, uvScale, image, ior, absorption, dispersion,
           specular, exponent, emission, normalMap, normalScale] = material;
    return std::tie(name, kind, albedo, pattern, patternAlbedo, uvScale, image, ior, absorption,
                    dispersion, specular, exponent, emission, normalMap, normalScale);
}

template <SameButConst<TextureImage> T>
auto partsOf(T& texture) {
    auto& [name, file, bytes, srgb, isNormalMap] = texture;
    return std::tie(name, file, bytes, srgb, isNormalMap);
}

template <SameButConst<HeightField> T>
auto partsOf(T& field) {
    auto& [size, cells, waves] = field;
    return std::tie(size, cells, waves);
}

template <SameButConst<Mesh> T>
auto partsOf(T& mesh) {
    auto& [name, origin, positions, normals, uvs, triangles, closed, hasInside, heightField] = mesh;
    return std::tie(name, origin, positions, normals, uvs, triangles, closed, hasInside,
                    heightField);
}

template <SameButConst<Emitter> T>
auto partsOf(T& emitter) {
    // What an environment is made of is in the scene.
    auto& [light, object, environment] = emitter;
    return std::tie(light, object);
}

template <SameButConst<Object> T>
auto partsOf(T& object) {
    auto& [name, mesh, material, toWorld] = object;
    return std::tie(name, mesh, material, toWorld);
}

template <SameButConst<Scene> T>
auto partsOf(T& scene) {
    // Bands are placed when it is rendered.
    auto& [name, description, file, extendedFiles, camera, lights, bands, emitters, materials,
           images, meshes, objects, medium, background, environment, environmentTurn,
           environmentLights, ambient, time, warnings] = scene;
    return std::tie(name, description, file, extendedFiles, camera, lights, emitters, materials,
                    images, meshes, objects, medium, background, environment, environmentTurn,
                    environmentLights, ambient, time, warnings);
}

template <SameButConst<ImportedMesh> T>
auto partsOf(T& imported) {
    auto& [mesh, warnings] = imported;
    return std::tie(mesh, warnings);
}

}  // namespace kaustik::scene
