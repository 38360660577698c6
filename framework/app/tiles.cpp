// SPDX-License-Identifier: MIT
// kaustik run --tile: traces photons on one tile of the screen; kaustik tiles: takes of all tiles'
// hits the first (K06, section 6).
#include <fmt/format.h>

#include "framework/app/commands.h"
#include "framework/core/error.h"
#include "framework/run/output.h"
#include "framework/run/tile_run.h"

namespace kaustik::app {
namespace {

void print(const run::TileCost& cost) {
    fmt::print(
        "{} pixels, {} with the border, {} layer fragments, {} photons, {} steps, {} "
        "squares\n",
        cost.ownPixels, cost.shownPixels, cost.fragments, cost.photons, cost.steps, cost.squares);
}

}  // namespace

void checkTileOptions(const RunOptions& options) {
    if (options.tiles.empty() && options.tile.empty()) return;
    if (options.tiles.empty())
        throw ConfigError("--tile: name the folder of all tiles' hits with --tiles.");
    if (!options.scene.disabled.empty())
        throw ConfigError("--tiles: passes cannot be switched off where tiles are traced apart.");
    if (options.timeStepSeconds != 0.0)
        throw ConfigError("--tiles: the hits are of one time, so there can be no --time-step.");
    if (options.tile.empty()) return;
    const bool wantsPicture = options.reference != "none" || !options.saved.empty() ||
                              options.captures || options.viewer || !options.out.empty();
    if (wantsPicture) {
        throw ConfigError(
            "--tile: one tile has no picture; --reference, --save, --capture, --tev and --out "
            "belong to the run with --tiles alone.");
    }
}

void traceTileCommand(const RunOptions& options, const Registry& registry) {
    const Shard tile = parseShard(options.tile, "--tile", "tile");
    const scene::Scene scene =
        loadRequestedScene(options.scene.scene, options.scene.time, options.scene.scenePlace);
    const RenderSettings settings = makeSettings(options.scene, registry, options.seed);
    static_cast<void>(tileOf(tile, settings.width, settings.height));
    const std::unique_ptr<gl::Context> context = gl::Context::createHeadless(options.scene.glDebug);
    run::requireWritable(options.tiles, "--tiles");
    const std::optional<run::TracedTile> traced =
        run::traceTile(*context, registry, scene, settings, options.tiles, tile);
    if (!traced) {
        fmt::print("no further round: 'kaustik run SCENE --tiles {}' makes the picture\n",
                   options.tiles);
        return;
    }
    fmt::print("{}, {}x{}, round {}, tile {}/{}: {} hits in {} bytes\n", scene.name, settings.width,
               settings.height, traced->head.round, tile.number, tile.count, traced->hits,
               traced->bytes);
    print(traced->head.cost);
    fmt::print("{} {}\n", traced->wasThere ? "it was there already:" : "wrote",
               traced->file.string());
}

void tilesCommand(const std::string& folder) {
    const std::optional<run::MergedRound> merged = run::mergeTiles(folder);
    if (merged) {
        fmt::print(
            "round {} of {} tiles: {} of {} photons hit something, {} of them a specular "
            "surface; {} bytes were exchanged\n",
            merged->head.round, merged->head.count, merged->hits, merged->photons,
            merged->specularHits, merged->bytes);
        for (std::size_t i = 0; i < merged->costs.size(); ++i) {
            fmt::print("tile {}: ", i + 1);
            print(merged->costs[i]);
        }
        fmt::print("wrote {}\n", merged->file.string());
    }
    const bool isComplete = !merged || merged->head.isComplete;
    fmt::print("{}\n", isComplete
                           ? fmt::format("no further round: 'kaustik run SCENE --tiles {}' makes "
                                         "the picture",
                                         folder)
                           : fmt::format("another round: 'kaustik run SCENE --tile K/{} --tiles "
                                         "{}' traces its tiles",
                                         merged->head.count, folder));
}

}  // namespace kaustik::app
