// SPDX-License-Identifier: MIT
#ifdef KAUSTIK_HAS_EMBREE

#include "framework/run/census_shards.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/core/json_text.h"

namespace kaustik::run {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

struct Part {
    fs::path file;
    json content;
    Shard shard;
};

[[noreturn]] void refuse(const fs::path& file) {
    throw ConfigError(fmt::format("{} is no shard of a census.", file.string()));
}

Part readPart(const fs::path& file) {
    Part part{file, parseJson(readFile(file), file.string()), {}};
    const json& content = part.content;
    if (!content.is_object() || content.value("schema", "") != "kaustik.census/1" ||
        !content.contains("shard"))
        refuse(file);
    part.shard = parseShard(content.at("shard").at("part"), file.string());
    return part;
}

// All parts of one census, in their order.
std::vector<Part> readParts(const std::vector<fs::path>& files) {
    std::vector<Part> parts;
    for (const fs::path& file : files) {
        parts.push_back(readPart(file));
        const json& first = parts.front().content;
        const json& here = parts.back().content;
        const auto requireSame = [&](const json& one, const json& other, const char* key) {
            if (one.at(key) == other.at(key)) return;
            throw ConfigError(
                fmt::format("{} and {} are shards of different censuses: by their {}.",
                            files.front().string(), file.string(), key));
        };
        for (const char* key : {"version", "scene", "device", "settings"})
            requireSame(first, here, key);
        for (const char* key : {"size", "photons", "rows"})
            requireSame(first.at("shard"), here.at("shard"), key);
        if (parts.back().shard.count != parts.front().shard.count) {
            throw ConfigError(fmt::format("{} is of {} shards, {} of {}.", files.front().string(),
                                          parts.front().shard.count, file.string(),
                                          parts.back().shard.count));
        }
    }
    std::sort(parts.begin(), parts.end(),
              [](const Part& a, const Part& b) { return a.shard.number < b.shard.number; });
    std::vector<std::uint64_t> missing;
    for (std::uint64_t number = 1; number <= parts.front().shard.count; ++number) {
        const auto isIt = [&](const Part& part) { return part.shard.number == number; };
        const auto times = std::count_if(parts.begin(), parts.end(), isIt);
        if (times == 0) missing.push_back(number);
        if (times > 1) throw ConfigError(fmt::format("--merge: shard {} is there twice.", number));
    }
    if (!missing.empty()) {
        throw ConfigError(fmt::format("--merge: of {} shards {} {} missing.",
                                      parts.front().shard.count, listOfNumbers(missing),
                                      missing.size() == 1 ? "is" : "are"));
    }
    return parts;
}

// What a file says of a technique; the rest follows from the census of paths.
TechniqueAccount accountFrom(const json& row, const reference::PathCensus& light) {
    TechniqueAccount account;
    account.technique = row.at("technique");
    account.isAsPublished = row.at("as_published");
    if (row.contains("problem")) {
        account.problem = row.at("problem");
        return account;
    }
    const json& models = row.at("models");
    account.paths.transmissionOnly = models.at("transmission_only");
    account.paths.reflectionOnly = models.at("reflection_only");
    account.paths.interactions = models.at("maximum_interactions");
    account.formedWatts = row.at("forms_w");
    for (const auto& [cause, watts] : row.at("loses_w").items())
        account.losses.emplace_back(cause, watts);
    for (const auto& [cause, watts] : row.at("not_followed_w").items())
        account.unfollowed.emplace_back(cause, watts);
    setLight(account, light);
    return account;
}

SceneCensus merge(const scene::Scene& scene, const std::vector<Part>& parts, const Watch& watch) {
    const Part& first = parts.front();
    const json& asked = first.content.at("shard");
    CensusRequest request;
    request.width = asked.at("size").at(0);
    request.height = asked.at("size").at(1);
    request.photons = asked.at("photons");
    SceneCensus census = censusOfPaths(scene, request, watch);
    census.device = first.content.at("device");
    census.settings = first.content.at("settings");
    census.rows = asked.at("rows").get<std::vector<std::string>>();
    // Processors may differ in the last bits.
    const double arrives = first.content.at("arriving").at("watts");
    if (scene.name != first.content.at("scene") ||
        std::abs(arrives - census.light.all.watts) > 1e-9 * census.light.all.watts) {
        throw ConfigError(fmt::format("{} is of another scene than {}, or of it at another time.",
                                      first.file.string(), scene.name));
    }
    census.techniques.resize(census.rows.size());
    for (const Part& part : parts) {
        const json& rows = part.content.at("techniques");
        std::size_t place = part.shard.number - 1;
        for (const json& row : rows) {
            if (place >= census.rows.size()) refuse(part.file);
            census.techniques[place] = accountFrom(row, census.light);
            if (census.techniques[place].rowName() != census.rows[place]) refuse(part.file);
            place += part.shard.count;
        }
        if (place < census.rows.size()) refuse(part.file);
    }
    return census;
}

}  // namespace

SceneCensus mergeCensus(const scene::Scene& scene, const std::vector<fs::path>& files,
                        const Watch& watch) {
    if (files.empty()) throw ConfigError("--merge: name the files of all shards.");
    try {
        return merge(scene, readParts(files), watch);
    } catch (const json::exception& error) {
        throw ConfigError(fmt::format("--merge: not all of {} is a shard of a census ({}).",
                                      files.front().parent_path().string(), error.what()));
    }
}

}  // namespace kaustik::run

#endif
