// SPDX-License-Identifier: MIT
// kaustik census: the watts of each class of a scene's caustic light, and what each technique
// forms, cannot form, and loses of them.
#include <fmt/format.h>

#include <filesystem>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"

#ifdef KAUSTIK_HAS_EMBREE
#include <nlohmann/json.hpp>

#include "framework/run/output.h"
#include "framework/run/technique_account.h"
#endif

namespace kaustik::app {

#ifndef KAUSTIK_HAS_EMBREE

void censusCommand(const CensusOptions&, const Registry&) {
    throw ConfigError("This program was built without Embree and cannot take a census of paths.");
}

#else

void censusCommand(const CensusOptions& options, const Registry& registry) {
    namespace fs = std::filesystem;
    // As many as a machine traces in some hours; below it is no statistics.
    constexpr long long kMinPhotons = 10'000;
    constexpr long long kMaxPhotons = 1'000'000'000'000;
    if (options.photons < kMinPhotons || options.photons > kMaxPhotons) {
        throw ConfigError(fmt::format("--photons: {} is not from {} to {}.", options.photons,
                                      kMinPhotons, kMaxPhotons));
    }
    const params::Extent size = params::parsePictureSize(options.size, "--size");
    run::CensusRequest request;
    request.width = size.width;
    request.height = size.height;
    request.photons = static_cast<std::uint64_t>(options.photons);
    request.techniquePhotons = options.techniquePhotons;
    request.techniques = options.techniques;
    for (const std::string& assignment : options.assignments)
        request.assignments.push_back(params::parseAssignment(assignment, "--set"));
    scene::Scene scene = loadRequestedScene(options.scene, options.time);
    const fs::path folder = options.out;
    if (!options.out.empty()) run::requireWritable(folder, "--out");
    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(false);
    run::catchInterrupts();
    run::SceneCensus census;
    {
        run::Progress progress("census:");
        census = run::accountFor(*context, registry, scene, request,
                                 {[] { return !run::isInterrupted(); },
                                  [&](double share, const std::string& reached) {
                                      progress.updateShare(share, reached);
                                  }});
    }
    const std::string text = jsonText(run::toJson(census), 2) + "\n";
    fmt::print("{}", options.json ? text : run::makeTable(census));
    if (options.out.empty()) return;
    fs::create_directories(folder);
    const auto write = [&](const char* name, const std::string& content) {
        writeFileWhole(folder / name, content);
        if (!options.json) fmt::print("wrote {}\n", (folder / name).string());
    };
    write("classes.csv", run::classesCsv(census));
    write("techniques.csv", run::techniquesCsv(census));
    write("census.json", text);
}

#endif

}  // namespace kaustik::app
