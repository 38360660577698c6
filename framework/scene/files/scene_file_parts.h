// SPDX-License-Identifier: MIT
// Makes the parts of a scene from the tables of a scene file, whose keys are in scene_keys.h.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/scene/files/scene_keys.h"
#include "framework/scene/scene.h"
#include "framework/scene/scene_edits.h"

namespace kaustik::scene {

// The scene of a table. What it names is looked for next to `path`, which is a folder with a '/' at
// its end where the table stands in no file: errors then begin with "the scene". `process` reads
// mesh files. Throws as loadSceneFile().
[[nodiscard]] Scene makeScene(const TomlNode& document, const std::filesystem::path& path,
                              reading::ReaderProcess& process);

[[nodiscard]] Camera readCamera(TableReader& reader);

// Sets the environment; a pattern becomes one of its images.
void readEnvironment(TableReader& reader, Scene& scene);

// These add the texture, if there is one, to the scene's images.
[[nodiscard]] Light readLight(TableReader& reader, Scene& scene);
[[nodiscard]] Material readMaterial(TableReader& reader, Scene& scene);

// Adds the object's mesh to the scene; objects of the same mesh file share it. The materials must
// have been read. `process` reads mesh files.
[[nodiscard]] Object readObject(TableReader& reader, Scene& scene, reading::ReaderProcess& process);

// What a scene file that extends another one changes.
[[nodiscard]] SceneEdits makeEdits(EditKeys keys);
// Reads edits from a table that has nothing else.
[[nodiscard]] SceneEdits readEdits(TableReader& top);

// The mesh of a shape; `reader` is the object's, for errors.
[[nodiscard]] Mesh makeShape(const Shape& shape, const TableReader& reader, double timeSeconds);

// The .toml files of a folder, by name; hidden ones are left out.
[[nodiscard]] std::vector<std::filesystem::path> sceneFilesIn(const std::filesystem::path& folder);

// ".pfm" of "a/B.PFM".
[[nodiscard]] std::string lowerExtension(const std::filesystem::path& path);

}  // namespace kaustik::scene
