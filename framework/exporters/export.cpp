// SPDX-License-Identifier: MIT
#include "framework/exporters/export.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "framework/core/error.h"
#include "framework/core/names.h"
#include "framework/exporters/parts.h"

namespace kaustik::exporters {
namespace {

constexpr std::array<std::pair<const char*, Format>, 4> kFormats{{{"povray", Format::povray},
                                                                  {"mitsuba", Format::mitsuba},
                                                                  {"gltf", Format::gltf},
                                                                  {"pbrt", Format::pbrt}}};

}  // namespace

Format formatOf(std::string_view name) {
    std::vector<std::string> names;
    for (const auto& [known, format] : kFormats) {
        if (name == known) return format;
        names.emplace_back(known);
    }
    throw ConfigError(fmt::format(
        "--to: there is no format '{}'{} There are povray, mitsuba, gltf "
        "and pbrt.",
        name,
        didYouMean(std::string(name), names).empty() ? "." : didYouMean(std::string(name), names)));
}

std::string sentenceOf(const ExportNote& note) {
    return fmt::format("{}: {}: {}", note.kind == NoteKind::leftOut ? "left out" : "changed",
                       note.subject, note.reason);
}

ExportedScene exportScene(const scene::Scene& scene, const ExportRequest& request) {
    if (request.photons < 1)
        throw ConfigError(fmt::format("--photons: {} is not above 0.", request.photons));
    if (scene.objects.empty())
        throw ConfigError(fmt::format("{} has no object to export.", scene.name));
    Exporter exporter(scene, request);
    exporter.noteSurroundings();
    switch (request.format) {
        case Format::povray:
            exportPovray(exporter);
            break;
        case Format::mitsuba:
            exportMitsuba(exporter);
            break;
        case Format::gltf:
            exportGltf(exporter);
            break;
        case Format::pbrt:
            exportPbrt(exporter);
            break;
    }
    return exporter.result;
}

}  // namespace kaustik::exporters
