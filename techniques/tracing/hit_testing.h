// SPDX-License-Identifier: MIT
// What the shaders of every screen-space tracer are told: the layers, and how a hit is tested.
#pragma once

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"

namespace kaustik {

struct HitTesting {
    TraceParams params;
    bool hasInside = false;    // the scene has closed dielectrics
    bool mayBeNested = false;  // with something in them
};
// Warns of a trace.epsilon that reaches through the scene.
[[nodiscard]] HitTesting hitTesting(FrameBuilder& frame);

// Says that the pass `pass` asks a ray in so many steps at most, its parameter `parameter`, where
// that is fewer than the picture's longer side has pixels.
void reportStepLimit(FrameBuilder& frame, const std::string& pass, const std::string& parameter,
                     int steps, const LayeredDepth& layers);

// Declares that a pass looks these layers up, under the names of include/views/hit_test.glsl, and
// tells its command how.
void readLayers(graph::PassSetup& setup, const LayeredDepth& layers);
// Where the layers are those of one tile of the screen, what a tracer that searches it gives
// next to hits: a pass that makes them, in the first of several batches, and one that goes on.
// Shaders are compiled as TILE_SEARCH (shaders/tracing/tile_search.glsl).
void createTileOutput(graph::PassSetup& setup, const LayeredDepth& layers, Hits& hits);
void rewriteTileOutput(graph::PassSetup& setup, const LayeredDepth& layers, Hits& hits);
// Throws ConfigError where rays of so many steps at most, `parameter`, skip pixels: then they could
// skip a tile's border as well.
void requireEveryPixel(const std::string& parameter, int steps, const LayeredDepth& layers);
// Sets which layers there are, and of which tile.
gl::Command& setHitTesting(gl::Command& command, const HitTesting& testing,
                           const LayeredDepth& layers);

}  // namespace kaustik
