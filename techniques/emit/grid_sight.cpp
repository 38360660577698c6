// SPDX-License-Identifier: MIT
#include "techniques/emit/grid_sight.h"

#include <utility>

#include "framework/core/error.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "techniques/emit/processor_sight.h"
#endif

namespace kaustik {

#ifndef KAUSTIK_HAS_EMBREE
class TracesSight {
  public:
    void read(graph::PassSetup& /*setup*/) const {}
};
#endif

namespace {

void draw(const FrameInputs& inputs, gl::PassContext& context, const GridSight& sight,
          const Geometry& geometry, const LightSight& seen, const GridRows& rows, int band) {
    gl::Command command = context.shaders({"emit/grid_sight.vert", "emit/grid_sight.frag"});
    command.target(sight.drawn).clear();
    command.depth(sight.depth, gl::DepthTest::nearerReversed).clear();
    const int width = rows.grid.width * rows.subcells;
    const int height = rows.grid.height * rows.subcells;
    command.viewport(0, -rows.firstSeen(band) * rows.subcells, width, height)
        .set("projection", seen.view.projection())
        .set("sightSize", glm::vec2(width, height));
    inputs.gpuScene.draw(command, context, geometry, *seen.instances, render::DrawSet::all);
}

}  // namespace

SightFinder::SightFinder(FrameBuilder& frame, SightBy by, bool isOfSquares,
                         const Geometry& geometry) {
#ifdef KAUSTIK_HAS_EMBREE
    // Of squares that are refined the whole grid would be traced.
    if (by == SightBy::automatic)
        by = frame.inputs().isOnProcessor && !isOfSquares ? SightBy::processor : SightBy::raster;
    if (by == SightBy::processor)
        traces_ = std::make_shared<TracesSight>(processorScene(frame, geometry));
#else
    static_cast<void>(frame);
    static_cast<void>(isOfSquares);
    static_cast<void>(geometry);
    if (by == SightBy::processor) {
        throw ConfigError(
            "emit.grid.sight = processor: this program is built without Embree; take raster.");
    }
#endif
}

GridSight SightFinder::create(graph::PassSetup& setup, const GridRows& rows,
                              const std::string& suffix) const {
    GridSight sight;
    const int width = rows.grid.width * rows.subcells;
    const int height = rows.seen() * rows.subcells;
    if (!isTraced()) {
        sight.drawn = setup.create<SightOfLight>("emit.sight" + suffix, width, height);
        sight.depth = setup.create<DepthBuffer>("emit.depth_buffer" + suffix, width, height);
        return sight;
    }
    traces_->read(setup);
    const auto count = [](int a, int b) {
        return static_cast<std::size_t>(a) * static_cast<std::size_t>(b);
    };
    sight.cells =
        setup.createBuffer<SightOfCell>("emit.sight" + suffix, count(rows.grid.width, rows.seen()));
    sight.parts =
        setup.createBuffer<std::uint32_t>("emit.sight_of_parts" + suffix, count(width, height));
    return sight;
}

void SightFinder::find(const FrameInputs& inputs, gl::PassContext& context, const GridSight& sight,
                       const Geometry& geometry, const LightSight& seen, const GridRows& rows,
                       int band) const {
    if (!isTraced()) return draw(inputs, context, sight, geometry, seen, rows, band);
#ifdef KAUSTIK_HAS_EMBREE
    if (context.isListing()) return;
    const SightOfRows found = traces_->find(seen.view, rows, band);
    context.buffer(sight.cells).upload(found.cells);
    context.buffer(sight.parts).upload(found.parts);
#endif
}

void SightFinder::bind(gl::Command& command, const GridSight& sight, const GridRows& rows,
                       int band) {
    command.set("subcells", rows.subcells)
        .set("sightFirstRow", rows.firstSeen(band))
        .set("gridSize", glm::ivec2(rows.grid.width, rows.grid.height));
    if (sight.drawn.valid()) {
        command.texture("sight", sight.drawn);
        return;
    }
    command.define("SIGHT_OF_CELLS")
        .texels("sightOfCells", sight.cells, Format::rgba32ui)
        .texels("sightOfParts", sight.parts, Format::r32ui)
        .set("sightRows", rows.seen());
}

}  // namespace kaustik
