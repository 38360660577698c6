// SPDX-License-Identifier: MIT
// First hits of photons from tiles of the screen (K06, section 6): as they leave the frame that has
// traced a tile, and as a frame takes them in place of a tracer.
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

class Renderer;

// Adds the pass that stands for a tracer: writes hits that are known and accounts for them, and for
// the photons that hit nothing, as the tracer does. When it runs it throws IoError where the list
// is not the one that was traced.
[[nodiscard]] Hits loadHits(FrameBuilder& frame, const Photons& photons, const FirstHits& known);

// What the tile's tracer has found of one list, and what it took; these wait for the device.
[[nodiscard]] FirstHits readFirstHits(const Renderer& renderer, const Hits& hits);
struct TileSearch {
    std::uint64_t photons = 0;  // whose rays cross the tile
    std::uint64_t steps = 0;    // as HitOrder counts them
    std::uint64_t squares = 0;
    std::uint64_t strayed = 0;  // hits whose surroundings lie beyond the tile's border
};
[[nodiscard]] TileSearch readTileSearch(const Renderer& renderer, const Hits& hits);

}  // namespace kaustik
