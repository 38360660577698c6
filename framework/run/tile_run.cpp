// SPDX-License-Identifier: MIT
#include "framework/run/tile_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/core/files.h"
#include "framework/pipeline/tile_hits.h"
#include "framework/scene/scene_hash.h"

namespace kaustik::run {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A step asks the pixel before its own, and the next step after a hit. Where a hit has strayed
// farther, the tile is traced once more with a wider border.
constexpr int kBorderPixels = 4;
constexpr int kBorderGrowth = 4;

void requireSame(const fs::path& file, const json& there, const json& here) {
    const std::string difference = differenceOf(there, here);
    if (!difference.empty())
        throw ConfigError(fmt::format("{} is of another run: {}.", file.string(), difference));
}

// Those that are merged, from the first on.
std::vector<TileFile> readRounds(const fs::path& folder) {
    std::vector<TileFile> rounds;
    for (int round = 1; fs::exists(roundPath(folder, round)); ++round)
        rounds.push_back(readTileFile(roundPath(folder, round)));
    return rounds;
}

std::vector<RoundOfHits> hitsOf(const std::vector<TileFile>& rounds) {
    std::vector<RoundOfHits> hits;
    for (const TileFile& round : rounds)
        hits.push_back(round.hits);
    return hits;
}

std::uint64_t pixelsOf(const PixelRegion& region) {
    const glm::ivec2 extent = region.end - region.first;
    return static_cast<std::uint64_t>(extent.x) * static_cast<std::uint64_t>(extent.y);
}

// Over all lists.
TileSearch readSearch(const Renderer& renderer) {
    TileSearch all;
    for (const Hits& hits : renderer.tileHits()) {
        const TileSearch search = readTileSearch(renderer, hits);
        all.photons += search.photons;
        all.steps += search.steps;
        all.squares += search.squares;
        all.strayed += search.strayed;
    }
    return all;
}

// Renders the tile with a border wide enough, and fills `content`.
void renderTile(gl::Context& context, const Registry& registry, const scene::Scene& scene,
                RenderSettings settings, const std::vector<RoundOfHits>& rounds,
                const PixelRegion& own, TileFile& content) {
    for (int border = kBorderPixels;; border *= kBorderGrowth) {
        const ScreenTile tile = withBorder(own, border, settings.width, settings.height);
        settings.tiles = std::make_shared<TileFrame>(TileFrame{rounds, tile});
        Renderer renderer(context, registry, scene, settings);
        renderer.build(Purpose::picture);
        gl::PassTimer timer(gl::TimerMode::finish);
        renderer.renderFrame(timer);
        const TileSearch search = readSearch(renderer);
        if (search.strayed > 0 && border < settings.width + settings.height) continue;
        for (const Hits& hits : renderer.tileHits())
            content.hits[hits.incoming.suffix] = readFirstHits(renderer, hits);
        content.head.maxRounds = renderer.maxRounds();
        content.head.cost = {
            pixelsOf(tile.own), pixelsOf(tile.shown), renderer.layerStatistics().fragments,
            search.photons,     search.steps,         search.squares};
        return;
    }
}

std::size_t hitCount(const RoundOfHits& round) {
    std::size_t count = 0;
    for (const auto& [suffix, list] : round)
        count += list.hits.size();
    return count;
}

// The tiles' files of a round, by tile; of N tiles, which their names say.
std::vector<fs::path> findTiles(const fs::path& folder, int round) {
    const std::regex name(fmt::format(R"(round-{}-tile-(\d{{1,7}})-of-(\d{{1,7}})\.hits)", round));
    std::map<std::uint64_t, fs::path> found;
    std::uint64_t count = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        std::smatch match;
        const std::string file = entry.path().filename().string();
        if (!std::regex_match(file, match, name)) continue;
        const std::uint64_t of = std::stoull(match[2]);
        if (count != 0 && of != count) {
            throw ConfigError(
                fmt::format("{}: round {} has tiles of {} and of {}; delete those "
                            "that are not meant.",
                            folder.string(), round, count, of));
        }
        count = of;
        found[std::stoull(match[1])] = entry.path();
    }
    if (count == 0) {
        throw ConfigError(fmt::format(
            "{}: no tile of round {} is there; 'kaustik run SCENE --tile K/N --tiles {}' traces "
            "one.",
            folder.string(), round, folder.string()));
    }
    std::vector<std::uint64_t> missing;
    std::vector<fs::path> files;
    for (std::uint64_t number = 1; number <= count; ++number) {
        if (found.contains(number)) {
            files.push_back(found[number]);
        } else {
            missing.push_back(number);
        }
    }
    if (!missing.empty()) {
        throw ConfigError(fmt::format("{}: of the {} tiles of round {} there is no {}.",
                                      folder.string(), count, round, listOfNumbers(missing)));
    }
    return files;
}

// Adds the hits of another tile: of two hits of one photon the first stays.
void mergeHits(FirstHits& all, const FirstHits& more) {
    std::vector<FirstHitTexels> merged;
    auto a = all.hits.begin();
    auto b = more.hits.begin();
    while (a != all.hits.end() || b != more.hits.end()) {
        const bool hasBoth = a != all.hits.end() && b != more.hits.end();
        if (hasBoth && a->photon == b->photon) {
            const bool isFirst = std::pair(a->order, a->step) <= std::pair(b->order, b->step);
            merged.push_back(isFirst ? *a : *b);
            ++a;
            ++b;
        } else if (b == more.hits.end() || (hasBoth && a->photon < b->photon)) {
            merged.push_back(*a++);
        } else {
            merged.push_back(*b++);
        }
    }
    all.hits = std::move(merged);
}

void mergeRound(RoundOfHits& all, const RoundOfHits& more, const fs::path& file) {
    if (all.size() != more.size())
        throw ConfigError(fmt::format("{} is of other photons than tile 1.", file.string()));
    for (const auto& [suffix, list] : more) {
        const auto own = all.find(suffix);
        if (own == all.end() || own->second.photons != list.photons ||
            own->second.rays != list.rays) {
            throw ConfigError(
                fmt::format("{} is of other photons than tile 1; trace both on "
                            "devices that compute alike.",
                            file.string()));
        }
        mergeHits(own->second, list);
    }
}

void requireFolder(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw ConfigError(fmt::format("--tiles: there is no folder {}.", folder.string()));
}

}  // namespace

json tileSubject(const gl::Context& context, const scene::Scene& scene,
                 const RenderSettings& settings) {
    ContentHash hash;
    scene::addTo(hash, scene);
    return {{"version", versionString()},
            {"device", context.info().renderer},
            {"scene", scene.name},
            {"scene_content", hash.hex()},
            {"time_s", scene.timeSeconds},
            {"technique", settings.technique.name},
            {"size", fmt::format("{}x{}", settings.width, settings.height)},
            {"seed", settings.seed},
            {"parameters", settings.params.json()}};
}

std::optional<TracedTile> traceTile(gl::Context& context, const Registry& registry,
                                    const scene::Scene& scene, const RenderSettings& settings,
                                    const fs::path& folder, const Shard& tile) {
    const PixelRegion own = tileOf(tile, settings.width, settings.height);
    TileFile content;
    content.head.subject = tileSubject(context, scene, settings);
    content.head.tile = tile;
    content.head.count = tile.count;
    const std::vector<TileFile> rounds = readRounds(folder);
    for (std::size_t i = 0; i < rounds.size(); ++i) {
        const fs::path file = roundPath(folder, static_cast<int>(i) + 1);
        requireSame(file, rounds[i].head.subject, content.head.subject);
        if (rounds[i].head.count != tile.count) {
            throw ConfigError(fmt::format("--tile: {} is of {} tiles, not of {}.", file.string(),
                                          rounds[i].head.count, tile.count));
        }
    }
    if (!rounds.empty() && rounds.back().head.isComplete) return {};
    content.head.round = static_cast<int>(rounds.size()) + 1;
    const fs::path file = tilePath(folder, content.head.round, tile);
    if (fs::exists(file)) {
        const TileFile there = readTileFile(file);
        requireSame(file, there.head.subject, content.head.subject);
        return TracedTile{there.head, file, fs::file_size(file), hitCount(there.hits), true};
    }
    renderTile(context, registry, scene, settings, hitsOf(rounds), own, content);
    const std::uint64_t bytes = writeTileFile(file, content);
    return TracedTile{content.head, file, bytes, hitCount(content.hits), false};
}

std::optional<MergedRound> mergeTiles(const fs::path& folder) {
    requireFolder(folder);
    const std::vector<TileFile> before = readRounds(folder);
    if (!before.empty() && before.back().head.isComplete) return {};
    const int round = static_cast<int>(before.size()) + 1;
    MergedRound merged;
    TileFile all;
    for (const fs::path& file : findTiles(folder, round)) {
        const TileFile tile = readTileFile(file);
        const bool isFirst = merged.costs.empty();
        if (isFirst && !before.empty())
            requireSame(file, tile.head.subject, before.back().head.subject);
        if (isFirst) {
            all = tile;
        } else {
            requireSame(file, tile.head.subject, all.head.subject);
            mergeRound(all.hits, tile.hits, file);
        }
        merged.costs.push_back(tile.head.cost);
        merged.bytes += fs::file_size(file);
    }
    for (const auto& [suffix, list] : all.hits) {
        merged.photons += list.photons;
        merged.hits += list.hits.size();
        merged.specularHits += static_cast<std::uint64_t>(
            std::count_if(list.hits.begin(), list.hits.end(), [](const FirstHitTexels& hit) {
                return hit.flux.w == static_cast<float>(transport::kFateSpecular);
            }));
    }
    all.head.tile.reset();
    all.head.cost = {};
    all.head.isComplete = merged.specularHits == 0 || round >= all.head.maxRounds;
    merged.head = all.head;
    merged.file = roundPath(folder, round);
    writeTileFile(merged.file, all);
    return merged;
}

std::shared_ptr<const TileFrame> loadTiles(const fs::path& folder, const json& subject) {
    requireFolder(folder);
    const std::vector<TileFile> rounds = readRounds(folder);
    if (rounds.empty() || !rounds.back().head.isComplete) {
        throw ConfigError(fmt::format(
            "--tiles: in {} photons are still on their way after {} merged rounds; 'kaustik run "
            "SCENE --tile K/N --tiles {}' traces the next, and 'kaustik tiles {}' merges it.",
            folder.string(), rounds.size(), folder.string(), folder.string()));
    }
    for (std::size_t i = 0; i < rounds.size(); ++i) {
        requireSame(roundPath(folder, static_cast<int>(i) + 1), rounds[i].head.subject, subject);
    }
    return std::make_shared<TileFrame>(TileFrame{hitsOf(rounds), {}});
}

}  // namespace kaustik::run
