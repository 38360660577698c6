// SPDX-License-Identifier: MIT
// emit.grid: photons on a regular grid of each light's view (K06, section 1.1; the
// render-to-vertex-buffer caustics of the time), where they first hit a specular surface. The
// grid is the tightest rectangle around the specular objects; one grid a light, stacked in the
// transfer map. Which triangle the light sees is drawn, or traced by the processor (grid_sight.h),
// by parts of a cell, so that the border of the light is known better than to a cell; the photon is
// where its ray hits that triangle. Out: photons that arrive (flux in W) and the hits that they
// make; eye view space, m.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/emit/grid_sight.h"
#include "techniques/light_cells/squares.h"
#include "techniques/photon_lists/emitted.h"
#include "techniques/thread_lists/thread_list.h"

namespace kaustik {
namespace {

struct GridEmissionParams {
    int subcells = 5;
    SightBy sight = SightBy::automatic;
    template <class R>
    void reflect(R& r) {
        r.field(
            subcells, "subcells",
            "Parts along each side of a cell by which the border of what a light sees is told; an "
            "odd number, and fewer where a light's view would exceed 4096 of them; 1: a cell is "
            "lit all or not at all",
            "", params::range(1, 7));
        r.choice(
            sight, "sight",
            "Who finds what a light sees first: raster draws it, all parts of all cells; "
            "processor traces the middles of cells, and parts of those at borders alone "
            "(Embree); auto: the processor where the device renders on it, but in squares that "
            "are refined",
            {"auto", "raster", "processor"});
    }
};

// Most parts along a side of a light's view.
constexpr int kMaxParts = 4096;

int subcellsOf(const GridEmissionParams& params, params::Extent grid) {
    const int maximum = std::min(params.subcells, kMaxParts / std::max(grid.width, grid.height));
    return std::max(maximum - (maximum + 1) % 2, 1);
}

SquareRoom squareRoomOf(const Samples& samples) {
    SquareRoom room{samples.refinement, 1, samples.cells.height};
    room.perRow = samples.cells.width / room.photonsOfSquare();
    return room;
}

struct GridEmission {
    Hits hits;
    GridSight sight;
    Geometry geometry;
    ThreadList cells;  // that see something specular; of squares all are taken
};

// The cells of a light in a band.
struct CellsOfBand {
    const LightSight& seen;
    const GridRows& rows;
    const Samples& samples;
    int band;
    int light;
    [[nodiscard]] int firstOfLight() const {
        return (light - samples.firstLight) * rows.cells.rows;
    }
};

// For shaders that include include/photons/light_grid.glsl.
void bindCells(const FrameInputs& inputs, gl::Command& command, const GridEmission& data,
               const CellsOfBand& of) {
    const auto& [seen, rows, samples, band, light] = of;
    SightFinder::bind(command, data.sight, rows, band);
    command.storage("Instances", inputs.instances.instances)
        .set("lightFromEye", render::between(inputs.view, seen.view))
        .set("halfExtent", glm::vec2(seen.view.halfExtent))
        .set("lightIndex", light)
        .set("cellsHere", glm::ivec2(rows.grid.width, rows.rowsIn(band)))
        .set("firstRow", rows.firstIn(band))
        .offer("firstOfLight", of.firstOfLight() + rows.firstIn(band) - rows.cells.firstRow);
}

void listCells(const FrameInputs& inputs, gl::PassContext& context, const GridEmission& data,
               const CellsOfBand& of) {
    data.cells.clear(context);
    gl::Command command = context.compute("emit/grid_list.comp");
    bindCells(inputs, command, data, of);
    command.storage("CellsToEmit", data.cells.buffer())
        .dispatchOver(of.rows.grid.width, 8, of.rows.rowsIn(of.band), 8);
    data.cells.close(context);
}

void dispatchOverCells(const FrameInputs& inputs, gl::Command command, const GridEmission& data,
                       const CellsOfBand& of) {
    const Samples& samples = of.samples;
    bindCells(inputs, command, data, of);
    inputs.gpuScene.bindTriangles(command, data.geometry);
    if (samples.cells.valid()) {
        const SquareRoom room = squareRoomOf(samples);
        command.define("REFINED_SQUARES")
            .storage("LightCells", samples.cells.cells)
            .set("refinement", samples.refinement)
            .set("squaresPerRow", room.perRow)
            .set("squareRows", room.rows)
            .offer("firstLightOfBatch", samples.firstLight);
        dispatchOver(command, data.hits.incoming);
        return;
    }
    command.define("LISTED_CELLS").texels("listedCells", data.cells.buffer(), Format::r32ui);
    data.cells.dispatchOver(std::move(command));
}

void emitFrom(const FrameInputs& inputs, gl::PassContext& context, const GridEmission& data,
              const CellsOfBand& of) {
    const auto& [seen, rows, samples, band, light] = of;
    const Photons& photons = data.hits.incoming;
    if (!samples.cells.valid()) listCells(inputs, context, data, of);
    gl::Command emission = context.compute("emit/grid.comp");
    emission.set("ownRows", glm::ivec2(rows.cells.firstOwn, rows.cells.endOwn));
    if (samples.refined.valid() && !samples.cells.valid()) {
        emission.define("LEAVES_OUT_REFINED")
            .storage("RefinedFlags", samples.refined)
            .set("batchRows", glm::ivec2(rows.cells.firstRow, rows.cells.rows))
            .set("lightOfBatch", light - samples.firstLight);
    }
    if (photons.extents.valid())
        emission.define("CELL_EXTENTS").image("nextExtents", photons.extents);
    dispatchOverCells(inputs, std::move(emission), data, of);
    if (!photons.hasBeams()) return;
    gl::Command beams = context.compute("emit/grid_beams.comp");
    beams.texture("photonPosition", photons.position)
        .texture("photonDirection", photons.direction)
        .texture("photonFlux", photons.flux)
        .texture("startSurface", data.hits.surface)
        .set("lightToEye", glm::mat3(render::between(seen.view, inputs.view)));
    dispatchOverCells(inputs, std::move(beams), data, of);
}

Hits emitGrid(FrameBuilder& frame, const GridEmissionParams& params, Surfaces surfaces,
              Samples samples) {
    const bool isOfSquares = samples.cells.valid();
    params::Extent grid = frame.photonsOfALight();
    if (isOfSquares) grid = {samples.refinement * grid.width, samples.refinement * grid.height};
    // The same for every batch.
    const int subcells = subcellsOf(params, grid);
    const auto grids = frame.once<std::vector<LightSight>>("emit.grids", [&] {
        if (subcells != params.subcells && !isOfSquares &&
            frame.inputs().params.isSetByUser("emit.grid.subcells")) {
            frame.warn(
                fmt::format("emit.grid.subcells = {} is taken as {}: an odd number, and no "
                            "more than {} parts along a side of a light's view.",
                            params.subcells, subcells, kMaxParts));
        }
        return std::make_shared<std::vector<LightSight>>(sightsOfSpecular(frame));
    });
    GridRows rows{grid, cellsOf(samples, grid), subcells};
    if (isOfSquares) {
        rows.cells = {};
        rows.cells.rows = grid.height;
        rows.cells.endOwn = grid.height;
    }
    // Where nothing is to be seen nobody traces.
    const SightFinder finder(frame, grids->empty() ? SightBy::raster : params.sight, isOfSquares,
                             surfaces.geometry);
    const std::string reason =
        grids->empty() ? "keeps the transfer map empty: no light, or nothing specular"
        : isOfSquares
            ? "finer photons in the squares that are refined"
            : fmt::format("{} photons a light, {} light{}; what it sees is {}",
                          grid.width * grid.height, grids->size(), grids->size() == 1 ? "" : "s",
                          finder.isTraced() ? "traced by the processor" : "drawn");
    return frame
        .pass<GridEmission>(
            "emit.grid", reason,
            [&](graph::PassSetup& setup, GridEmission& data) {
                data.geometry = surfaces.geometry;
                if (data.geometry.heightFields.valid()) setup.read(data.geometry.heightFields);
                if (isOfSquares) {
                    setup.read(samples.cells.cells);
                    setup.read(samples.cells.list);
                }
                const int height =
                    isOfSquares ? samples.cells.height : rows.cells.rows * samples.lights;
                Photons photons =
                    Photons::create(setup, isOfSquares ? samples.cells.width : grid.width, height,
                                    samples.suffix, {frame.usesBeams()}, samples.cells);
                photons.cells =
                    isOfSquares ? cellsOfSquares(squareRoomOf(samples), samples) : rows.cells;
                if (samples.refined.valid()) setup.read(samples.refined);
                if (rows.subcells > 1 || samples.refinement > 1) {
                    photons.extents = setup.create<CellExtentTexel>(
                        "photons.extents" + samples.suffix, photons.cells.width,
                        photons.cells.rows * samples.lights);
                }
                data.hits = storeEmitted(setup, photons, samples);
                data.sight = finder.create(setup, rows, samples.suffix);
                if (isOfSquares) return;
                data.cells = ThreadList::create(
                    setup, "CellsToEmit", "emit.cells" + samples.suffix,
                    static_cast<std::size_t>(grid.width) *
                        static_cast<std::size_t>(std::min(rows.bandRows(), rows.cells.rows)));
            },
            [&inputs = frame.inputs(), grids, samples, rows, finder](const GridEmission& data,
                                                                     gl::PassContext& context) {
                const Photons& photons = data.hits.incoming;
                beginEmission(context, photons, samples);
                // Cells without a photon say so themselves (emit/grid_list.comp). Textures that are
                // kept, for pictures and scans, are whole.
                if (grids->empty() || isAnyKept(context, data.hits))
                    clearEmitted(context, data.hits);
                const int end = grids->empty() ? 0 : samples.firstLight + samples.lights;
                for (int light = samples.firstLight; light < end; ++light) {
                    const LightSight& seen =
                        (*grids)[static_cast<std::size_t>(light) % grids->size()];
                    for (int band = rows.firstBand(); band < rows.endBand(); ++band) {
                        finder.find(inputs, context, data.sight, data.geometry, seen, rows, band);
                        emitFrom(inputs, context, data, {seen, rows, samples, band, light});
                    }
                }
            })
        .hits;
}

}  // namespace

void registerEmitGrid(Registry& registry) {
    registry.node<EmitStage>(
        "grid",
        {"Rasterises the scene from each light, one photon a "
         "cell where a specular surface is first.",
         "K06, section 1.1",
         "A specular object smaller than a part of a cell may be missed, which the ledger calls "
         "emission_sampling. A light that would have to see wider than 160 degrees emits nothing "
         "beyond that, and a warning says so."},
        {.beams = true}, &emitGrid);
}

}  // namespace kaustik
