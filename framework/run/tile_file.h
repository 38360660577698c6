// SPDX-License-Identifier: MIT
// Files in which first hits go from the runs that trace tiles of the screen to the next round and
// to the picture (K06, section 6). FOLDER/round-R-tile-K-of-N.hits is what one tile has found after
// the R-th interaction, FOLDER/round-R.hits the first hits of all tiles. Three lines, a format, a
// head in JSON and its checksum, then the hits, little-endian: those of a tile alone, which is all
// that tiles exchange.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "framework/pipeline/tiles.h"

namespace kaustik::run {

// What tracing one tile took.
struct TileCost {
    std::uint64_t ownPixels = 0;
    std::uint64_t shownPixels = 0;  // with the border
    std::uint64_t fragments = 0;    // of the layers, with the border
    std::uint64_t photons = 0;      // whose rays cross the tile
    std::uint64_t steps = 0;    // of rays that were asked; where squares are skipped, of a layer
    std::uint64_t squares = 0;  // that were asked whether they can be skipped
};

struct TileHead {
    nlohmann::json subject;     // what the hits depend on but for the tile: all of it must agree
    std::optional<Shard> tile;  // none: the first hits of all
    std::uint64_t count = 1;    // tiles of the screen
    int round = 1;              // after so many interactions of each photon
    int maxRounds = 1;          // after so many no photon goes on
    bool isComplete = false;    // of all tiles: no photon goes on after this round
    TileCost cost;              // of one tile
};

struct TileFile {
    TileHead head;
    RoundOfHits hits;
};

[[nodiscard]] std::filesystem::path tilePath(const std::filesystem::path& folder, int round,
                                             const Shard& tile);
[[nodiscard]] std::filesystem::path roundPath(const std::filesystem::path& folder, int round);

// Gives the bytes of the file, which is there whole or not at all.
std::uint64_t writeTileFile(const std::filesystem::path& file, const TileFile& content);
// Throws IoError where the file cannot be read or is damaged.
[[nodiscard]] TileFile readTileFile(const std::filesystem::path& file);

// The first thing in which two subjects differ, as "emit.photons is 32x32 there and 64x64 here";
// "" where they agree.
[[nodiscard]] std::string differenceOf(const nlohmann::json& there, const nlohmann::json& here);

}  // namespace kaustik::run
