// SPDX-License-Identifier: MIT
#include "techniques/light_cells/squares.h"

#include <fmt/format.h>

#include <algorithm>

#include "framework/pipeline/stage_params.h"
#include "framework/transport/photon_list.h"
#include "framework/transport/primitives.h"
#include "techniques/generators/culling.h"
#include "techniques/light_cells/refine_stage.h"
#include "techniques/photon_lists/branches.h"
#include "techniques/photon_lists/photon_paths.h"
#include "techniques/reconstruct/triangles.h"

namespace kaustik {
namespace {

constexpr int kSquaresPerRow = 256;
constexpr int kMaxTextureRows = 16384;
// Photons of a round: enough to keep a device busy, few enough to need no memory to speak of.
constexpr int kMinRound = 65536;
constexpr int kMaxRound = 262144;

struct Start {
    Ledger ledger;  // of the probes, which is not read
    graph::Buffer<transport::CellCounts> counts;
};
struct Emitted {
    graph::Buffer<float> cellFlux;
    graph::Buffer<std::uint32_t> parted;
    graph::Buffer<transport::CellCounts> counts;
};

std::size_t squareRows(const CellGrid& cells) {
    return static_cast<std::size_t>(cells.rows + 1) * static_cast<std::size_t>(cells.lights);
}
std::size_t squareCount(const CellGrid& cells) {
    return squareRows(cells) * static_cast<std::size_t>(cells.width + 1);
}

Start startProbes(FrameBuilder& frame, const Samples& samples,
                  const graph::Buffer<transport::CellCounts>& before) {
    return frame.pass<Start>(
        "squares.start", "photons are asked first where they arrive",
        [&](graph::PassSetup& setup, Start& data) {
            data.ledger = setup.createBuffer<transport::LedgerEntry>(
                "squares.ledger" + samples.suffix, transport::kLedgerEntryCount);
            data.counts = before.valid()
                              ? before
                              : setup.createBuffer<transport::CellCounts>("squares.counts", 1);
        },
        [isFirst = !before.valid()](const Start& data, gl::PassContext& context) {
            context.buffer(data.ledger).clear();
            if (isFirst) context.buffer(data.counts).clear();
        });
}

// What the light sends through each cell, and counts the photons.
Emitted countEmitted(FrameBuilder& frame, const Hits& emitted,
                     const graph::Buffer<transport::CellCounts>& counts) {
    const CellGrid& cells = emitted.incoming.cells;
    return frame.pass<Emitted>(
        "squares.emitted", "what each square's light is",
        [&](graph::PassSetup& setup, Emitted& data) {
            emitted.incoming.sample(setup);
            const std::string& suffix = emitted.incoming.suffix;
            data.cellFlux = setup.storage(
                "CellFlux",
                setup.createBuffer<float>("squares.cell_flux" + suffix, cells.places()));
            data.parted =
                setup.createBuffer<std::uint32_t>("squares.parted" + suffix, squareCount(cells));
            data.counts = setup.storage("CellCounting", setup.write(counts));
        },
        [list = emitted.incoming](const Emitted& data, gl::PassContext& context) {
            context.buffer(data.cellFlux).clear();
            context.buffer(data.parted).clear();
            gl::Command command = context.compute("light_cells/squares_emitted.comp");
            setCells(command, list.cells);
            dispatchOver(command, list);
        });
}

}  // namespace

SquareRoom squareRoom(const FrameBuilder& frame, int parts, int lights) {
    const params::Extent grid = frame.photonsOfALight();
    const int batch = frame.params<EmitParams>("emit").batch >> branchLevels(frame);
    const int photons =
        std::max(std::min({std::clamp(grid.width * grid.height, kMinRound, kMaxRound), batch}), 1);
    SquareRoom room{parts, kSquaresPerRow, 0};
    const int squares = photons / room.photonsOfSquare();
    const int rows = kMaxTextureRows / ((parts + 2) * std::max(lights, 1));
    room.rows = std::clamp(squares / room.perRow, 1, std::max(rows, 1));
    return room;
}

CellGrid cellsOfSquares(const SquareRoom& room, const Samples& samples) {
    CellGrid cells;
    cells.width = room.perRow * (room.parts + 2);
    cells.rows = room.rows * (room.parts + 2);
    cells.firstLight = samples.firstLight;
    cells.lights = samples.lights;
    cells.endOwn = cells.rows;
    return cells;
}

RefinedSquares findRefined(FrameBuilder& frame, const Surfaces& surfaces, const Samples& samples,
                           float share, graph::Buffer<transport::CellCounts> counts) {
    const FrameBuilder::PassScope within(frame, RefineStage::name);
    Samples probes = samples;
    probes.suffix = ".probes" + samples.suffix;
    const Start start = startProbes(frame, samples, counts);
    probes.ledger = start.ledger;
    Hits hits = frame.run<EmitStage>(surfaces, probes);
    const CellGrid cells = hits.incoming.cells;
    Emitted state = countEmitted(frame, hits, start.counts);
    int interactions = 1;
    for (int i = 0; i < interactions; ++i) {
        hits = endAtUnseen(frame, hits);
        const Photons photons = frame.run<SpecularStage>(hits, surfaces);
        interactions = interactionCount(frame, photons.paths);
        hits = frame.run<TraceStage>(photons, surfaces);
        state.parted = addParted(frame, surfaces, hits, state.cellFlux, state.parted);
    }
    struct Data {
        RefinedSquares refined;
        graph::Buffer<std::uint32_t> rows;
    };
    return frame
        .pass<Data>(
            "squares.list",
            fmt::format("finer photons where more than {:g} of a square's light is not joined",
                        share),
            [&](graph::PassSetup& setup, Data& data) {
                setup.storage("PartedShares", state.parted);
                data.refined.flags = setup.storage(
                    "RefinedFlags", setup.createBuffer<std::uint32_t>(
                                        "squares.refined" + samples.suffix, squareCount(cells)));
                data.rows = setup.storage(
                    "SquareRows", setup.createBuffer<std::uint32_t>("squares.rows" + samples.suffix,
                                                                    squareRows(cells)));
                data.refined.list = setup.storage(
                    "RefinedSquares", setup.createBuffer<transport::LightCell>(
                                          "squares.list" + samples.suffix, squareCount(cells)));
                data.refined.counts = setup.storage("CellCounting", setup.write(state.counts));
            },
            [cells, share](const Data&, gl::PassContext& context) {
                for (int step = 0; step < 3; ++step) {
                    gl::Command command = context.compute("light_cells/squares_list.comp");
                    command.set("listStep", step)
                        .offer("refineShare", share)
                        .set("cellGrid", glm::ivec2(cells.width, cells.rows))
                        .set("cellFirstRow", cells.firstRow)
                        .set("cellLights", glm::ivec2(cells.firstLight, cells.lights))
                        .set("cellOwnRows", glm::ivec2(cells.firstOwn, cells.endOwn));
                    if (step == 1) {
                        command.dispatch(1);
                    } else {
                        command.dispatchOver(static_cast<int>(squareRows(cells)), 64);
                    }
                }
            })
        .refined;
}

SquareRound takeSquares(FrameBuilder& frame, const RefinedSquares& refined, const SquareRoom& room,
                        const std::string& suffix) {
    return frame.pass<SquareRound>(
        "driver.squares", "squares whose light takes different ways are refined",
        [&](graph::PassSetup& setup, SquareRound& data) {
            setup.storage("RefinedSquares", refined.list);
            data.counts = setup.storage("CellCounting", setup.write(refined.counts));
            data.squares.width = room.perRow * room.photonsOfSquare();
            data.squares.height = room.rows;
            data.squares.cells = setup.storage(
                "TakenSquares",
                setup.createBuffer<transport::LightCell>(
                    "squares.taken" + suffix, static_cast<std::size_t>(room.capacity())));
            data.squares.list = setup.storage(
                "TakenList", setup.createBuffer<transport::PhotonList>("photons.list" + suffix, 1));
        },
        [room](const SquareRound&, gl::PassContext& context) {
            gl::Command count = context.compute("light_cells/squares_take.comp");
            count.define("COUNT")
                .set("maxSquares", static_cast<unsigned>(room.capacity()))
                .set("photonsOfSquare", static_cast<unsigned>(room.photonsOfSquare()))
                .set("rowLength", static_cast<unsigned>(room.perRow * room.photonsOfSquare()))
                .dispatch(1);
            context.compute("light_cells/squares_take.comp")
                .set("maxSquares", static_cast<unsigned>(room.capacity()))
                .dispatchOver(room.capacity(), 64);
        });
}

}  // namespace kaustik
