// SPDX-License-Identifier: MIT
// driver.adaptive: photons where their light needs them (WN09, section 3.2). Each light's view is a
// quadtree of cells. In a round the cells that were found last, as many as there is room for, have
// a probe in each of their quarters; the stage refine drops them, splits them, or makes photons of
// them. Once there are as many photons as the memory holds, or no more cells, the photons are
// followed as the dense driver follows its own; then the next batch begins. Depth first: what waits
// is bounded by the rounds' size and the levels, and which photons there are depends on no limit.
//
// The nodes that emit, interact and trace serve probes and photons alike. What probes lose goes to
// a ledger of their own, which is not read; metrics that do not ask where light arrives have
// probes that end where they start. Where a medium scatters, a traversal of its own chooses photons
// whose paths are drawn in it (WN09, section 6).
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "framework/core/error.h"
#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "framework/transport/primitives.h"
#include "techniques/light_cells/cell_lists.h"
#include "techniques/light_cells/landing.h"
#include "techniques/light_cells/refine_stage.h"
#include "techniques/photon_lists/branches.h"
#include "techniques/photon_lists/photon_paths.h"

namespace kaustik {
namespace {

using transport::CellCounts;
using transport::LightCell;

// Of the largest storage block that every device has (OpenGL 4.5, table 23.64).
constexpr std::size_t kPromisedBlockBytes = std::size_t{1} << 27;

int powerOfTwo(const char* name, int value) {
    if (std::has_single_bit(static_cast<unsigned>(value))) return value;
    throw ConfigError(fmt::format("refine.{} = {} is no power of two; {} and {} are.", name, value,
                                  std::bit_floor(static_cast<unsigned>(value)),
                                  std::bit_ceil(static_cast<unsigned>(value))));
}

int levelOf(int cells) {
    return std::bit_width(static_cast<unsigned>(cells)) - 1;
}

// What photons are chosen for, and by what.
struct Purpose {
    std::string suffix;  // of its resources
    RefineMetric metric = RefineMetric::map;
    LandingSource landing = LandingSource::probe;
    float tolerance = 1.0f;
    TraversalSizes sizes;
    PhotonUse use;
};

// Cells that a round leaves for each that it takes: no more than four a level.
std::size_t cellsLeftBehind(const TraversalSizes& sizes) {
    return 4 * static_cast<std::size_t>(sizes.finestLevel - sizes.startLevel + 1);
}

// Cells that wait before the first round.
std::size_t cellsAtStart(const FrameBuilder& frame, const TraversalSizes& sizes) {
    return (std::size_t{1} << (2 * sizes.startLevel)) *
           static_cast<std::size_t>(frame.needs().photonLights);
}

LightCells makeList(graph::PassSetup& setup, const std::string& name, const std::string& listName,
                    const ListCapacity& room) {
    LightCells list;
    list.width = room.width;
    list.height = room.height;
    list.cells = setup.createBuffer<LightCell>("adaptive." + name,
                                               static_cast<std::size_t>(list.capacity()));
    list.list = setup.createBuffer<transport::PhotonList>(listName, 1);
    return list;
}

struct Start {
    CellTraversal traversal;
    Ledger ledger;   // of the photons
    Ledger scratch;  // of the probes
};

// The cells of which the first probes are the quarters.
Start start(FrameBuilder& frame, const Purpose& purpose) {
    const TraversalSizes& sizes = purpose.sizes;
    const int lights = frame.needs().photonLights;
    const auto side = static_cast<unsigned>(1 << sizes.startLevel);
    const std::size_t cells = cellsAtStart(frame, sizes);
    const std::size_t rounds =
        static_cast<std::size_t>(sizes.round.capacity()) * cellsLeftBehind(sizes);
    return frame.pass<Start>(
        "driver.start",
        fmt::format("{0} x {0} cells of {1} light{2}, no more than {3} at once", 2 * side, lights,
                    lights == 1 ? "" : "s", sizes.probes.capacity()),
        [&](graph::PassSetup& setup, Start& data) {
            CellTraversal& t = data.traversal;
            t.suffix = purpose.suffix;
            t.tolerance = purpose.tolerance;
            t.checkLevel = purpose.sizes.checkLevel;
            t.waiting =
                setup.createBuffer<LightCell>("adaptive.waiting" + t.suffix, cells + rounds);
            t.counts = setup.createBuffer<CellCounts>("adaptive.counts" + t.suffix, 1);
            t.photons =
                makeList(setup, "photons" + t.suffix, "photons.list" + t.suffix, sizes.photons);
            data.ledger = setup.createBuffer<transport::LedgerEntry>("ledger" + t.suffix,
                                                                     transport::kLedgerEntryCount);
            data.scratch = setup.createBuffer<transport::LedgerEntry>(
                "adaptive.probes_ledger" + t.suffix, transport::kLedgerEntryCount);
        },
        [side, cells, level = sizes.startLevel](const Start& data, gl::PassContext& context) {
            context.buffer(data.ledger).clear();
            context.buffer(data.scratch).clear();
            context.buffer(data.traversal.photons.list).clear();
            // The counts too, on the device: uploaded, they were gone in a graph's first frame on
            // NVIDIA's 580.159.04, which clears the buffer just before (results/device.md).
            context.compute("driver/adaptive_start.comp")
                .storage("WaitingCells", data.traversal.waiting)
                .storage("CellCounting", data.traversal.counts)
                .set("side", side)
                .set("level", static_cast<unsigned>(level))
                .set("cellCount", static_cast<unsigned>(cells))
                .dispatchOver(std::max(static_cast<int>(cells), 1), 64);
        });
}

// Takes the cells that were found last, and makes probes of their quarters.
CellTraversal take(FrameBuilder& frame, const CellTraversal& before, const TraversalSizes& sizes) {
    return frame.pass<CellTraversal>(
        "driver.take", "cells that wait are looked at, those found last before others",
        [&](graph::PassSetup& setup, CellTraversal& data) {
            data = before;
            data.counts = setup.storage("CellCounting", setup.write(before.counts));
            data.taken = makeList(setup, "taken" + data.suffix, "adaptive.taken_list" + data.suffix,
                                  sizes.round);
            data.probes = makeList(setup, "probes" + data.suffix,
                                   "photons.list" + data.suffix + ".probes", sizes.probes);
            setup.storage("WaitingCells", before.waiting);
            setup.storage("TakenCells", data.taken.cells);
            setup.storage("TakenList", data.taken.list);
            setup.storage("ProbeCells", data.probes.cells);
            setup.storage("ProbeList", data.probes.list);
        },
        [sizes](const CellTraversal& data, gl::PassContext& context) {
            context.compute("driver/adaptive_take_count.comp")
                .set("maxTaken", static_cast<unsigned>(sizes.round.capacity()))
                .set("maxPhotons", static_cast<unsigned>(sizes.photons.capacity()))
                .set("takenRow", static_cast<unsigned>(sizes.round.width))
                .set("probeRow", static_cast<unsigned>(sizes.probes.width))
                .dispatch(1);
            context.compute("driver/adaptive_take.comp")
                .dispatchIndirect(data.taken.list, offsetof(transport::PhotonList, groupsX));
        });
}

// Follows the probes to where they arrive.
CellTraversal probe(FrameBuilder& frame, CellTraversal traversal, const Surfaces& surfaces,
                    Ledger& scratch, const Purpose& purpose) {
    const FrameBuilder::PassScope within(frame, RefineStage::name);
    Samples samples;
    samples.suffix = purpose.suffix + ".probes";
    samples.cells = traversal.probes;
    samples.ledger = scratch;
    Hits hits = frame.run<EmitStage>(surfaces, samples);
    traversal.first = hits;
    scratch = hits.incoming.ledger;
    if (purpose.metric == RefineMetric::traversal) return traversal;
    ProbeNumbers numbers;
    int interactions = 1;
    for (int i = 0; i < interactions; ++i) {
        const Photons photons = frame.run<SpecularStage>(hits, surfaces);
        interactions = interactionCount(frame, photons.paths);
        if (i == 0) {
            traversal.branches = 1 << branchLevels(frame);
            const CellTraversal before = traversal;
            traversal = frame.pass<CellTraversal>(
                "landings", "nothing has landed yet",
                [&](graph::PassSetup& setup, CellTraversal& data) {
                    data = before;
                    setup.storage("ProbeList", before.probes.list);
                    data.landings = setup.storage(
                        "Landings",
                        setup.createBuffer<light_cells::Landing>(
                            "adaptive.landings" + before.suffix,
                            static_cast<std::size_t>(before.probes.capacity() * before.branches)));
                },
                [](const CellTraversal& data, gl::PassContext& context) {
                    context.compute("light_cells/landings_none.comp")
                        .set("branches", static_cast<unsigned>(data.branches))
                        .dispatchIndirect(data.probes.list,
                                          offsetof(transport::PhotonList, groupsX));
                });
        }
        hits = frame.run<TraceStage>(photons, surfaces);
        scratch = hits.incoming.ledger;
        numbers = followProbes(frame, "follow", numbers, hits);
        traversal.landings =
            findLandings(frame, "land", traversal.landings, hits, surfaces, purpose.metric,
                         purpose.landing, numbers, traversal.branches);
    }
    return traversal;
}

// Makes room for the next batch's photons.
CellTraversal nextBatch(FrameBuilder& frame, const CellTraversal& before) {
    return frame.pass<CellTraversal>(
        "driver.next", "the next photons need the memory of these",
        [&](graph::PassSetup& setup, CellTraversal& data) {
            data = before;
            data.counts = setup.storage("CellCounting", setup.write(before.counts));
        },
        [](const CellTraversal&, gl::PassContext& context) {
            context.compute("driver/adaptive_next.comp").dispatch(1);
        });
}

// All photons of one purpose, batch by batch.
void traverse(FrameBuilder& frame, const Surfaces& surfaces, const Purpose& purpose,
              Caustic& caustic) {
    Start begun = start(frame, purpose);
    CellTraversal traversal = begun.traversal;
    traversal.geometry = surfaces.geometry;
    if (purpose.use.stores) caustic.map.ledger = begun.ledger;
    frame.beginLoop();
    frame.beginLoop();
    traversal = take(frame, traversal, purpose.sizes);
    traversal = probe(frame, traversal, surfaces, begun.scratch, purpose);
    traversal = frame.run<RefineStage>(traversal);
    // Shaders leave a traversal as it is that has come to its end.
    frame.endLoop(traversal.counts, offsetof(CellCounts, moreCells) / sizeof(unsigned), true);
    Samples samples;
    samples.suffix = purpose.suffix;
    samples.cells = traversal.photons;
    samples.ledger = begun.ledger;
    followPhotons(frame, surfaces, samples, caustic, purpose.use);
    traversal = nextBatch(frame, traversal);
    frame.endLoop(traversal.counts, offsetof(CellCounts, moreBatches) / sizeof(unsigned), true);
    if (purpose.use.stores) caustic.cells = traversal.counts;
}

Caustic driveAdaptive(FrameBuilder& frame, const params::NoParams&, Surfaces surfaces) {
    const FrameInputs& inputs = frame.inputs();
    if (!frame.traits<EmitStage>().emitsCells) {
        throw ConfigError(fmt::format(
            "driver.adaptive asks for photons one by one, which emit.{} does not make; take "
            "emit=deferred.",
            inputs.params.choice(EmitStage::name)));
    }
    const auto& params = frame.params<RefineParams>("refine");
    warnNothingJoined(frame);
    if (params.isMetricUnasked()) {
        frame.warn(fmt::format(
            "refine.finest = {} is below refine.check = {}: refine.metric is never asked, and "
            "all that holds something specular is split to the finest cells.",
            params.finest, params.check));
    }
    Purpose map{"", params.metric, LandingSource::probe, params.tolerance, sizesOf(frame, params),
                {}};
    const bool scatters = frame.needs().scatteringMedium;
    const bool isApart =
        scatters && params.medium > 0.0f && params.metric != RefineMetric::traversal;
    map.use.scatters = !isApart;
    Caustic caustic;
    traverse(frame, surfaces, map, caustic);
    if (isApart) {
        // Paths of light vary much less over the picture than where it arrives.
        Purpose medium{".medium",     RefineMetric::eye, LandingSource::path,
                       params.medium, map.sizes,         {false, true, {}}};
        medium.sizes.checkLevel = medium.sizes.startLevel + 1;
        const FrameBuilder::PassScope within(frame, MediaStage::name);
        traverse(frame, surfaces, medium, caustic);
    }
    finishMedia(frame, caustic);
    return caustic;
}

}  // namespace

TraversalSizes sizesOf(const FrameBuilder& frame, const RefineParams& params) {
    TraversalSizes sizes;
    sizes.finestLevel = levelOf(powerOfTwo("finest", params.finest));
    // The first probes are quarters of the cells that are there at the start.
    sizes.startLevel = std::min(levelOf(powerOfTwo("start", params.start)), sizes.finestLevel) - 1;
    sizes.checkLevel = levelOf(powerOfTwo("check", params.check));
    // Two lists of photons and their hits at a time, of probes and of photons; cells, landings.
    const double branches = std::exp2(branchLevels(frame));
    const double each =
        branches * (2.0 * (frame.usesBeams() ? 160.0 : 112.0) + sizeof(light_cells::Landing)) +
        3.0 * sizeof(LightCell);
    const double maximum = static_cast<double>(params.memoryMebibytes) * 1048576.0 / each;
    // There are no more than there are finest cells; more at once would be no faster, and textures
    // have an end.
    const double cells = frame.needs().photonLights * std::exp2(2.0 * sizes.finestLevel);
    const double end = std::clamp(std::ceil(cells / 4096.0) * 4096.0, 4096.0, 16777216.0);
    const int photons = static_cast<int>(std::clamp(maximum, 4096.0, end)) / 4096 * 4096;
    sizes.photons = {2048, std::max(photons / 2048, 2)};
    // A round takes a quarter of the probes' number, and all that waits is in one storage block.
    const std::size_t mostWaiting = kPromisedBlockBytes / sizeof(LightCell);
    const std::size_t atStart = std::min(cellsAtStart(frame, sizes), mostWaiting);
    const auto mostTaken = static_cast<int>((mostWaiting - atStart) / cellsLeftBehind(sizes));
    sizes.round = {1024, std::clamp(mostTaken / 1024, 1, photons / 4 / 1024)};
    sizes.probes = {2048, std::max(4 * sizes.round.capacity() / 2048, 2)};
    return sizes;
}

void registerDriverAdaptive(Registry& registry) {
    registry.node<DriverStage>(
        "adaptive",
        {"Photons of the cells of each light's view that the stage refine has found, in "
         "batches that fit into refine.memory.",
         "WN09, sections 3.2 and 4.3",
         "It needs an emitter that makes photons cell by cell, emit=deferred, and refuses every "
         "other; emit.photons and emit.batch have no effect. What is thinner than a texel of "
         "emit.deferred.size is not found."},
        {.refines = true,
         .parameters = "refine.finest and refine.memory",
         .whyNoNeighbours =
             [](const FrameFacts&) {
                 return std::string("photons of driver=adaptive are of cells of any size");
             }},
        &driveAdaptive);
}

}  // namespace kaustik
