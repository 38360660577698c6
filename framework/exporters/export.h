// SPDX-License-Identifier: MIT
// A scene in the files of another renderer, with its meshes: what `kaustik export` writes.
// framework/exporters/README.md has the table of what each format keeps; what of a scene it does
// not keep is a note.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::exporters {

enum class Format { povray, mitsuba, gltf, pbrt };

// Throws ConfigError that names the nearest format for one that there is not.
[[nodiscard]] Format formatOf(std::string_view name);

struct ExportRequest {
    Format format = Format::povray;
    std::filesystem::path folder;
    int width = 800;  // pixels
    int height = 600;
    long long photons = 1'000'000;  // that its renderer is asked to shoot, about
};

enum class NoteKind { leftOut, changed };

struct ExportNote {
    NoteKind kind = NoteKind::leftOut;
    std::string subject;  // light 'sun'
    std::string reason;
};
// "left out: light 'sun': …"
[[nodiscard]] std::string sentenceOf(const ExportNote& note);

struct ExportedScene {
    std::filesystem::path sceneFile;
    std::string renderCommand;  // to be run in the folder
    std::size_t objectCount = 0;
    std::size_t lightCount = 0;
    std::size_t fileCount = 0;  // all that were written
    std::vector<ExportNote> notes;
};

// Writes the scene at its time: the file of the scene is the last. Colours are linear Rec.709 and
// lengths are metres. Radiance in the other renderer's picture is ours in W/m²/sr; only glTF has
// units of its own (683 lm/W). Throws ConfigError for a scene that has nothing to export, and
// IoError for a picture that cannot be read or a file that cannot be written.
[[nodiscard]] ExportedScene exportScene(const scene::Scene& scene, const ExportRequest& request);

}  // namespace kaustik::exporters
