// SPDX-License-Identifier: MIT
// Photons traced on tiles of the screen by runs that know nothing of each other (K06, section 6:
// "only the first intersection points along each photon's ray have to be communicated"). In each
// round every tile is traced once; merging a round says whether there is another. Every run begins
// from the scene: it emits the photons, takes the rounds before from files, and traces its tile
// after that.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "framework/pipeline/renderer.h"
#include "framework/run/tile_file.h"

namespace kaustik::run {

// What first hits depend on but for the tile.
[[nodiscard]] nlohmann::json tileSubject(const gl::Context& context, const scene::Scene& scene,
                                         const RenderSettings& settings);

struct TracedTile {
    TileHead head;
    std::filesystem::path file;
    std::uint64_t bytes = 0;
    std::size_t hits = 0;
    bool wasThere = false;  // from an earlier run
};
// Traces the tile in the first round that is not merged, unless its file is there. None where no
// photon goes on after the rounds that are merged. Throws ConfigError where these are of something
// else.
[[nodiscard]] std::optional<TracedTile> traceTile(gl::Context& context, const Registry& registry,
                                                  const scene::Scene& scene,
                                                  const RenderSettings& settings,
                                                  const std::filesystem::path& folder,
                                                  const Shard& tile);

struct MergedRound {
    TileHead head;
    std::filesystem::path file;
    std::vector<TileCost> costs;  // by tile
    std::uint64_t bytes = 0;      // of the tiles' files
    std::uint64_t photons = 0;
    std::uint64_t hits = 0;
    std::uint64_t specularHits = 0;  // whose photons go on, unless the round is the last
};
// Takes of all tiles' hits in the first round that is not merged the first along each photon's ray.
// None where all rounds are merged. Throws ConfigError where tiles are missing or do not belong
// together.
[[nodiscard]] std::optional<MergedRound> mergeTiles(const std::filesystem::path& folder);

// What a frame takes in place of a tracer. Throws ConfigError where rounds are missing or are of
// something else.
[[nodiscard]] std::shared_ptr<const TileFrame> loadTiles(const std::filesystem::path& folder,
                                                         const nlohmann::json& subject);

}  // namespace kaustik::run
