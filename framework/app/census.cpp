// SPDX-License-Identifier: MIT
// kaustik census: the watts of each class of a scene's caustic light, and what each technique
// forms, cannot form, and loses of them.
#include <fmt/format.h>

#include <filesystem>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"
#include "framework/core/shard.h"

#ifdef KAUSTIK_HAS_EMBREE
#include <nlohmann/json.hpp>

#include "framework/run/census_shards.h"
#include "framework/run/output.h"
#include "framework/run/technique_account.h"
#endif

namespace kaustik::app {

#ifndef KAUSTIK_HAS_EMBREE

void censusCommand(const CensusOptions&, const Registry&) {
    throw ConfigError("This program was built without Embree and cannot take a census of paths.");
}

#else

namespace {

run::SceneCensus takeOrMerge(const CensusOptions& options, const Registry& registry,
                             scene::Scene& scene, const run::CensusRequest& request) {
    run::Progress progress("census:");
    const run::Watch watch{
        [] { return !run::isInterrupted(); },
        [&](double share, const std::string& reached) { progress.updateShare(share, reached); }};
    if (!options.merged.empty()) {
        return run::mergeCensus(scene, {options.merged.begin(), options.merged.end()}, watch);
    }
    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(false);
    return run::accountFor(*context, registry, scene, request, watch);
}

}  // namespace

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
    const bool isShard = !options.shard.empty();
    if (isShard && !options.merged.empty())
        throw ConfigError("census: --shard makes a part, --merge puts parts together; take one.");
    if (isShard && options.out.empty())
        throw ConfigError("--shard: give --out, a folder for the part.");
    if (isShard) request.shard = parseShard(options.shard, "--shard");
    scene::Scene scene = loadRequestedScene(options.scene, options.time);
    const fs::path folder = options.out;
    if (!options.out.empty()) run::requireWritable(folder, "--out");
    run::catchInterrupts();
    const run::SceneCensus census = takeOrMerge(options, registry, scene, request);
    const std::string text = jsonText(run::toJson(census), 2) + "\n";
    fmt::print("{}", options.json ? text : run::makeTable(census));
    if (options.out.empty()) return;
    fs::create_directories(folder);
    const auto write = [&](const char* name, const std::string& content) {
        writeFileWhole(folder / name, content);
        if (!options.json) fmt::print("wrote {}\n", (folder / name).string());
    };
    if (isShard) {
        const std::string name =
            fmt::format("census-{}-of-{}.json", request.shard->number, request.shard->count);
        return write(name.c_str(), text);
    }
    write("classes.csv", run::classesCsv(census));
    write("techniques.csv", run::techniquesCsv(census));
    write("census.json", text);
}

#endif

}  // namespace kaustik::app
