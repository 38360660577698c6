// SPDX-License-Identifier: MIT
#include "techniques/tracing/hit_testing.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "framework/core/error.h"

namespace kaustik {

HitTesting hitTesting(FrameBuilder& frame) {
    const auto params = frame.params<TraceParams>("trace");
    constexpr double kWide = 0.05;  // of the scene's extent
    const scene::Bounds bounds = sceneBounds(frame.scene());
    const double extent = bounds.empty ? 0.0 : glm::length(bounds.maximum - bounds.minimum);
    const auto epsilon = static_cast<double>(params.epsilonMeters);
    if (params.test != HitTest::crossing && epsilon > kWide * extent) {
        frame.once<bool>("trace.epsilon", [&] {
            frame.warn(fmt::format(
                "trace.epsilon = {:.3g} m is {:.0f}% of the scene's extent: rays hit what they "
                "pass at that distance; trace.test=crossing needs none.",
                epsilon, 100.0 * epsilon / extent));
            return std::make_shared<bool>(true);
        });
    }
    return {params, frame.needs().closedDielectrics, frame.needs().nestedBodies};
}

void reportStepLimit(FrameBuilder& frame, const std::string& pass, const std::string& parameter,
                     int steps, const LayeredDepth& layers) {
    const int longerSide = std::max(layers.views->width(), layers.views->height());
    if (steps >= longerSide) return;
    const ReachedLimit limit{
        parameter,
        "steps",
        static_cast<double>(steps),
        static_cast<double>(longerSide),
        fmt::format("rays of more than {} pixels on the screen skip some of them, and what is "
                    "seen there alone is missed",
                    steps),
        0.0};
    frame.reportLimit({pass, {}, [limit](const gl::Executor&) { return limit; }});
}

void createTileOutput(graph::PassSetup& setup, const LayeredDepth& layers, Hits& hits) {
    if (!layers.tile) return;
    const Photons& photons = hits.incoming;
    hits.order = setup.image("hitOrder", setup.create<HitOrder>("hits.order" + photons.suffix,
                                                                photons.width, photons.height));
    setup.define("TILE_SEARCH");
}

void rewriteTileOutput(graph::PassSetup& setup, const LayeredDepth& layers, Hits& hits) {
    if (!layers.tile) return;
    hits.order = setup.image("hitOrder", setup.write(hits.order));
    setup.define("TILE_SEARCH");
}

void requireEveryPixel(const std::string& parameter, int steps, const LayeredDepth& layers) {
    const int longerSide = std::max(layers.views->width(), layers.views->height());
    if (!layers.tile || steps >= longerSide) return;
    throw ConfigError(fmt::format(
        "--tile: {} = {} lets rays skip pixels of the picture, whose longer side has {}; set it "
        "to 0.",
        parameter, steps, longerSide));
}

void readLayers(graph::PassSetup& setup, const LayeredDepth& layers) {
    setup.sample("layerDepths", layers.depth);
    setup.sample("layerSurfaces", layers.surface);
}

gl::Command& setHitTesting(gl::Command& command, const HitTesting& testing,
                           const LayeredDepth& layers) {
    if (testing.params.test != HitTest::crossing) command.define("EPSILON_TEST");
    if (testing.params.test == HitTest::inOut) command.define("IN_OUT_TEST");
    // Only what has an inside can be left where no layer's plane is crossed.
    if (testing.hasInside && testing.params.test != HitTest::epsilon)
        command.define("CLOSED_DIELECTRICS");
    if (testing.mayBeNested) command.define("NESTED_BODIES");
    if (layers.views) layers.views->bindTo(command);
    if (layers.tile) {
        const ScreenTile& tile = *layers.tile;
        command.offer("tileOwn", glm::vec4(tile.own.first, tile.own.end))
            .offer("tileShown", glm::vec4(tile.shown.first, tile.shown.end));
    }
    return command.params("trace", testing.params).set("layerCount", layers.layers);
}

}  // namespace kaustik
