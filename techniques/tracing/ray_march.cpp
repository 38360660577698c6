// SPDX-License-Identifier: MIT
#include "techniques/tracing/ray_march.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "framework/core/error.h"
#include "framework/pipeline/frame_builder.h"
#include "techniques/tracing/hit_testing.h"

namespace kaustik {
namespace {

// With 0 for as many steps as the longer side has pixels.
MarchParams withSteps(const LayeredDepth& layers, MarchParams params) {
    if (params.steps == 0) params.steps = std::max(layers.views->width(), layers.views->height());
    return params;
}

void createTileOutput(graph::PassSetup& setup, Hits& hits) {
    const Photons& photons = hits.incoming;
    hits.step = setup.image("hitStep", setup.create<HitStep>("hits.step" + photons.suffix,
                                                             photons.width, photons.height));
    hits.tileCounts = setup.storage(
        "TileCounts", setup.createBuffer<transport::TileCount>("hits.tile_counts" + photons.suffix,
                                                               transport::kTileCounts));
    setup.define("TILE_SEARCH");
}

void setTile(gl::Command& command, const ScreenTile& tile) {
    command.set("tileOwn", glm::vec4(tile.own.first, tile.own.end))
        .set("tileShown", glm::vec4(tile.shown.first, tile.shown.end));
}

// Rays that skip pixels could skip the border of a tile as well.
void requireEveryPixel(const std::string& parameter, int steps, const LayeredDepth& layers) {
    const int longerSide = std::max(layers.views->width(), layers.views->height());
    if (!layers.tile || steps >= longerSide) return;
    throw ConfigError(fmt::format(
        "--tile: {} = {} lets rays skip pixels of the picture, whose longer side has {}; set it "
        "to 0.",
        parameter, steps, longerSide));
}

}  // namespace

Hits marchRays(FrameBuilder& frame, const RayMarch& march, const MarchParams& wanted,
               const Photons& photons, const LayeredDepth& layers) {
    const std::string name = "trace." + march.node;
    const MarchParams params = withSteps(layers, wanted);
    const bool isThread = march.shader.ends_with(".comp");
    reportStepLimit(frame, name, name + ".steps", params.steps, layers);
    requireEveryPixel(name + ".steps", params.steps, layers);
    return frame.pass<Hits>(
        name,
        isThread ? "one thread a photon follows its ray" : "one fragment a photon follows its ray",
        [&](graph::PassSetup& setup, Hits& hits) {
            readLayers(setup, layers);
            if (march.skipsSquares) setup.sample("layerPyramid", layers.pyramid);
            photons.sample(setup);
            hits = Hits::create(setup, photons);
            hits.incoming.account(setup);
            if (isThread) hits.store(setup);
            if (layers.tile) createTileOutput(setup, hits);
        },
        [testing = hitTesting(frame), name, shader = march.shader, params, isThread, layers](
            const Hits& hits, gl::PassContext& context) {
            gl::Command command = isThread
                                      ? context.compute(shader)
                                      : context.shaders({"framework/photon_rows.vert", shader});
            setHitTesting(command, testing, layers).params(name, params);
            if (layers.tile) setTile(command, *layers.tile);
            if (hits.tileCounts.valid()) context.buffer(hits.tileCounts).clear();
            if (isThread) return dispatchOver(command, hits.incoming);
            for (const graph::ResourceRef& texture : hits.textures())
                command.target(texture);
            drawOver(command);
        });
}

}  // namespace kaustik
