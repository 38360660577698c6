// SPDX-License-Identifier: MIT
// Scenes by name and from scene files. experiments/scenes/README.md describes the format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

// Reads and validates a scene file. Throws ConfigError "file:line: …" for whatever the file says
// that makes no sense, and IoError for a file that cannot be read, here or at a mesh or a texture.
[[nodiscard]] Scene loadSceneFile(const std::filesystem::path& path);

// Whether a path ends as those of scenes do: .toml, .gltf or .glb, in any case, or names a mesh of
// the user's own (own_mesh.h).
[[nodiscard]] bool isSceneFile(const std::filesystem::path& path);

// A scene by its name in experiments/scenes, from a .toml, .gltf or .glb file, or with a mesh of
// the user's own, which a .gltf or .glb without lights is taken for. Throws
// ConfigError for a name that does not exist, with the nearest one and all there are.
[[nodiscard]] Scene loadScene(const std::string& nameOrPath);

struct SceneListing {
    std::string name;  // what `loadScene` takes
    std::string description;
    std::filesystem::path file;
};

// The scenes of experiments/scenes by name. A file that is not valid TOML is listed all the same;
// its description then says what is wrong.
[[nodiscard]] std::vector<SceneListing> listScenes();

}  // namespace kaustik::scene
