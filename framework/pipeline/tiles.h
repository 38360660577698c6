// SPDX-License-Identifier: MIT
// Screen tiles (K06, section 6): photons are met with the layers of one tile of the screen only,
// and of the first hits of all tiles the first along each photon's ray counts. After each specular
// interaction there is such an exchange, a round. Here is what a frame is told of it, and what
// rounds hand on.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/shard.h"

namespace kaustik {

// Pixels [first, end) of a view, from the lower left.
struct PixelRegion {
    glm::ivec2 first{0};
    glm::ivec2 end{0};
    bool operator==(const PixelRegion&) const = default;
};

// The pixels of one of N tiles, columns and rows of the picture in which each side is shared out
// evenly, so that they are as near to squares as N allows. Throws ConfigError where some tile would
// have no pixel.
[[nodiscard]] PixelRegion tileOf(const Shard& tile, int width, int height);

// A tile, and the pixels whose layers are there: its own and a border, by which what is next to a
// hit is known.
struct ScreenTile {
    PixelRegion own;
    PixelRegion shown;
};
[[nodiscard]] ScreenTile withBorder(const PixelRegion& own, int border, int width, int height);

// One photon's first hit, as the textures of Hits have it.
struct FirstHitTexels {
    std::uint32_t photon = 0;  // place in its list
    std::uint32_t order = 0;   // of several tiles' hits the one of the least is the first, …
    std::uint32_t step = 0;  // … or, where that is the same, that on the earlier step of the ray
    glm::vec4 position{0.0f};
    glm::vec4 surface{0.0f};
    glm::vec4 flux{0.0f};
    glm::vec4 shape{0.0f};  // zeros where photons have no beams
};

// The hits of one list of photons in their order; photons that are not among them hit nothing.
struct FirstHits {
    std::uint32_t photons = 0;
    std::string rays;  // a fingerprint of the photons' rays
    std::vector<FirstHitTexels> hits;
};
// Those of all lists that are traced after one interaction, by their suffixes (Photons::suffix).
using RoundOfHits = std::map<std::string, FirstHits>;

// What a frame does with tiles.
struct TileFrame {
    std::vector<RoundOfHits> rounds;  // that are known: no tracer runs for them
    std::optional<ScreenTile> tile;   // to be traced in the round after these; none: all rounds are
                                      // known, and the frame goes on to the picture
};

}  // namespace kaustik
