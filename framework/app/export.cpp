// SPDX-License-Identifier: MIT
// kaustik export: a scene in the files of another renderer.
#include <fmt/format.h>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/exporters/export.h"
#include "framework/params/assignment.h"
#include "framework/run/output.h"
#include "framework/scene/files/scene_file.h"

namespace kaustik::app {

void exportCommand(const ExportOptions& options) {
    const params::Extent size = params::parsePictureSize(options.size, "--size");
    const exporters::Format format = exporters::formatOf(options.to);
    run::requireWritable(options.out, "--out");
    const scene::Scene scene = loadRequestedScene(options.scene, options.time);
    const exporters::ExportedScene written = exporters::exportScene(
        scene, {format, options.out, size.width, size.height, options.photons});
    fmt::print("wrote {}: {} objects, {} lights, {} files\nto render it: {}\n",
               written.sceneFile.string(), written.objectCount, written.lightCount,
               written.fileCount, written.renderCommand);
    for (const exporters::ExportNote& note : written.notes)
        fmt::print("{}\n", exporters::sentenceOf(note));
}

}  // namespace kaustik::app
