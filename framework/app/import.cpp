// SPDX-License-Identifier: MIT
// kaustik import: scenes of other renderers as scene files.
#include <fmt/format.h>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/reading/reader_process.h"
#include "framework/scene/files/scene_file_parts.h"
#include "framework/scene/foreign/foreign_export.h"

namespace kaustik::app {
namespace {

std::string counted(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

void importCommand(const ImportOptions& options) {
    if (options.missingTextures != "error" && options.missingTextures != "grey") {
        throw ConfigError(fmt::format("--missing-textures: '{}' is neither error nor grey.",
                                      options.missingTextures));
    }
    if (scene::lowerExtension(options.out) != ".toml")
        throw ConfigError(fmt::format("--out: '{}' is no .toml file.", options.out));
    reading::ReaderProcess reader;
    const scene::ForeignScene foreign = scene::readForeignScene(options.file, reader);
    const scene::ExportedScene written = scene::exportForeignScene(
        foreign, {options.out, options.file, options.missingTextures == "grey"}, reader);
    const std::string files =
        written.fileCount == 0 ? ""
                               : fmt::format(", and {} in {}", counted(written.fileCount, "file"),
                                             written.fileFolder.string());
    fmt::print("wrote {}: {}, {}{}\nto render it: {}\n", options.out,
               counted(written.objectCount, "object"), counted(written.lightCount, "light"), files,
               written.runCommand);
    for (const scene::ForeignNote& note : written.notes)
        fmt::print("{}\n", scene::sentenceOf(note));
}

}  // namespace kaustik::app
