// SPDX-License-Identifier: MIT
// Options that several subcommands have, and how their values are checked.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "framework/app/options.h"

namespace kaustik::app {

inline constexpr const char* kDeviceModelHelp =
    "A bandwidth of memory, such as 1000GB/s: one more frame counts what each pass reads and "
    "writes, and says how long that takes there at least";
inline constexpr const char* kSceneHelp =
    "A name from 'list scenes', a .toml, .gltf or .glb, or a mesh: .obj, .ply, .stl, .3ds";

// --device and --no-program-cache. What follows, and every program that it starts, finds them in
// the environment.
void addDeviceOption(CLI::App& command);
// How any scene is rendered: the technique, its parameters, the size and the device.
void addPictureOptions(CLI::App& command, SceneOptions& options);
// How a mesh of the user's own is put into a scene.
void addOwnMeshOptions(CLI::App& command, OwnMeshOptions& options);
// All of the above with the scene, files of settings and the time.
void addSceneOptions(CLI::App& command, SceneOptions& options);
// What is wrong with a whole number that 64 bits do not hold; "" where nothing is.
[[nodiscard]] std::string integerRangeError(const std::string& text);

}  // namespace kaustik::app
