// SPDX-License-Identifier: MIT
// A foreign scene as a scene file, with the meshes and pictures that it needs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/reading/reader_process.h"
#include "framework/scene/foreign/foreign_scene.h"

namespace kaustik::scene {

struct ExportOptions {
    std::filesystem::path out;       // the .toml
    std::filesystem::path source;    // the foreign file, for the head of the scene file
    bool isGreyWithoutFile = false;  // a texture that is not there is grey, not an error
};

struct ExportedScene {
    std::string runCommand;          // what renders it at the foreign scene's size
    std::vector<ForeignNote> notes;  // those of the reader, and what the writing adds
    std::size_t objectCount = 0;
    std::size_t lightCount = 0;
    std::size_t fileCount = 0;         // in the folder of meshes and pictures
    std::filesystem::path fileFolder;  // next to the scene file: NAME_meshes
};

// "left out: shape 'x' (scene.xml:120): …"
[[nodiscard]] std::string sentenceOf(const ForeignNote& note);

// Writes the scene file, last of all, and what it names: meshes that no keys say and files that lie
// elsewhere go to a folder next to it. `reader` reads mesh files. Throws IoError for a texture that
// is not there or a file that cannot be written, and ConfigError for what has no extent.
[[nodiscard]] ExportedScene exportForeignScene(const ForeignScene& scene,
                                               const ExportOptions& options,
                                               reading::ReaderProcess& reader);

}  // namespace kaustik::scene
