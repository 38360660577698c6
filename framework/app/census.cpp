// SPDX-License-Identifier: MIT
// kaustik census: the watts of each class of a scene's caustic light, and what each technique
// forms, cannot form, and loses of them. With --out the rows of techniques are kept one by one.
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

namespace fs = std::filesystem;
using nlohmann::json;

// The rows that run::accountFor() deals out to shards.
std::vector<run::SettingsRequest> rowsOf(const Registry& registry,
                                         const run::CensusRequest& request) {
    std::vector<std::string> names = request.techniques;
    if (names.empty()) {
        for (const Technique& technique : registry.techniques())
            names.push_back(technique.name);
    }
    std::vector<params::Assignment> assignments = request.assignments;
    assignments.insert(
        assignments.begin(),
        params::parseAssignment("emit.photons=" + request.techniquePhotons, "--set"));
    std::vector<run::SettingsRequest> rows;
    for (const std::string& name : names) {
        rows.push_back({name, assignments});
        if (registry.findTechnique(name).asPublished.empty()) continue;
        rows.push_back({name, assignments});
        rows.back().isAsPublished = true;
    }
    return rows;
}

// What a part of a census was made of, for and by: all but the part itself.
std::string originOf(json part) {
    part.erase("techniques");
    part.at("shard").erase("part");
    return jsonText(part);
}

bool isPartOf(const fs::path& file, const std::string& origin) {
    if (!fs::exists(file)) return false;
    try {
        return originOf(parseJson(readFile(file), file.string())) == origin;
    } catch (const std::exception&) {
        return false;  // it is made again
    }
}

// Each row is a shard of its own, in a file that the next call finds where this one is interrupted.
run::SceneCensus takeRowByRow(gl::Context& context, const Registry& registry, scene::Scene& scene,
                              const run::CensusRequest& request, const run::Watch& watch,
                              const fs::path& unfinished) {
    const std::vector<run::SettingsRequest> rows = rowsOf(registry, request);
    for (const run::SettingsRequest& row : rows)
        static_cast<void>(run::makeSettings(row, registry));
    const auto account = [&](const Shard& shard, const run::Watch& by) {
        run::CensusRequest part = request;
        part.shard = shard;
        return run::toJson(run::accountFor(context, registry, scene, part, by));
    };
    // A shard that gets no row: only the census of paths, which is kept elsewhere.
    const std::string origin = originOf(account({kMaxShards, kMaxShards}, watch));
    std::vector<fs::path> files;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        files.push_back(unfinished / fmt::format("census-{}-of-{}.json", i + 1, rows.size()));
        if (isPartOf(files.back(), origin)) continue;
        const run::Watch here{
            watch.shouldContinue, [&](double, const std::string& reached) {
                watch.tell(static_cast<double>(i) / static_cast<double>(rows.size()), reached);
            }};
        try {
            writeFileWhole(files.back(), jsonText(account({i + 1, rows.size()}, here), 2) + "\n");
        } catch (const Error&) {
            if (!run::isInterrupted()) throw;
            throw Error(fmt::format("Interrupted after {} of {} rows of techniques; the same "
                                    "command goes on from there.",
                                    i, rows.size()),
                        kExitFailed);
        }
    }
    return run::mergeCensus(scene, files, watch);
}

run::SceneCensus takeOrMerge(const CensusOptions& options, const Registry& registry,
                             scene::Scene& scene, const run::CensusRequest& request,
                             const fs::path& unfinished) {
    run::Progress progress("census:");
    const run::Watch watch{
        [] { return !run::isInterrupted(); },
        [&](double share, const std::string& reached) { progress.updateShare(share, reached); }};
    if (!options.merged.empty()) {
        return run::mergeCensus(scene, {options.merged.begin(), options.merged.end()}, watch);
    }
    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(false);
    return options.out.empty() || request.shard
               ? run::accountFor(*context, registry, scene, request, watch)
               : takeRowByRow(*context, registry, scene, request, watch, unfinished);
}

}  // namespace

void censusCommand(const CensusOptions& options, const Registry& registry) {
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
    const fs::path unfinished = folder / "census.unfinished";
    const run::SceneCensus census = takeOrMerge(options, registry, scene, request, unfinished);
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
    std::error_code ignored;
    fs::remove_all(unfinished, ignored);
}

#endif

}  // namespace kaustik::app
