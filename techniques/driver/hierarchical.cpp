// SPDX-License-Identifier: MIT
// driver.hierarchical: hierarchical caustic maps (W08, as WN09 describe them). All photons of the
// lights' grids are followed, as by the dense driver; over those that arrive with each tracing a
// mip map is built, of where they are and of their flux, and walked from the top: the coarsest
// squares of cells whose light arrives within refine.tolerance texels are stored as one photon with
// all of their flux. Squares that hold several surfaces or paths are walked further down.
#include <array>
#include <cstdint>

#include "framework/core/error.h"
#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/light_cells/landing.h"
#include "techniques/light_cells/refine_stage.h"
#include "techniques/photon_lists/photon_paths.h"

namespace kaustik {
namespace {

// Squares of up to 64 cells a side are one photon.
constexpr int kLevels = 6;

// As shaders/driver/hierarchical.glsl has it.
struct HierarchyNode {
    glm::vec2 low, high;
    glm::vec4 flux;
    std::uint32_t first, middle, state, signature;
};

// The squares of each level, for every light and branch, one level after the other.
struct HierarchyLayout {
    std::array<glm::ivec2, kLevels + 1> sizes;
    std::array<int, kLevels + 1> firsts{};
    int grids = 1;
    int nodes = 0;
    HierarchyLayout(const CellGrid& cells) : grids(cells.lights << cells.splits) {
        sizes[0] = {cells.width, cells.rows};
        for (int level = 1; level <= kLevels; ++level) {
            const glm::ivec2 below = sizes[static_cast<std::size_t>(level - 1)];
            const auto l = static_cast<std::size_t>(level);
            // Rows count from the grid's own first, so that batches share out whole squares.
            sizes[l] = {(below.x + 1) / 2, (below.y + 1) / 2};
            firsts[l] = nodes;
            nodes += sizes[l].x * sizes[l].y * grids;
        }
    }
};

struct Merged {
    Hits hits;
    graph::Buffer<transport::CellCounts> counts;
};

Merged mergeArriving(FrameBuilder& frame, const Hits& hits, const Surfaces& surfaces,
                     const RefineParams& params, graph::Buffer<transport::CellCounts> counts) {
    const Photons& photons = hits.incoming;
    if (photons.cells.width == 0) {
        if (frame.traits<TraceStage>().multipliesLight) {
            throw ConfigError(fmt::format(
                "driver.hierarchical needs a photon a cell, and trace.{} makes several of one; "
                "take trace=hierarchical.",
                frame.inputs().params.choice(TraceStage::name)));
        }
        throw ConfigError(
            "driver.hierarchical needs photons of cells that are neighbours; take emit=grid or "
            "emit=deferred.");
    }
    using Landings = graph::Buffer<light_cells::Landing>;
    Landings landings = frame.pass<Landings>(
        "driver.landings", "nothing has landed yet",
        [&](graph::PassSetup& setup, Landings& data) {
            data = setup.createBuffer<light_cells::Landing>(
                "hierarchy.landings" + photons.suffix,
                static_cast<std::size_t>(photons.capacity()));
        },
        [](const Landings& data, gl::PassContext& context) { context.buffer(data).clear(); });
    landings =
        findLandings(frame, "driver.land", landings, hits, surfaces,
                     params.metric == RefineMetric::eye ? RefineMetric::eye : RefineMetric::map,
                     LandingSource::photon);
    const HierarchyLayout layout(photons.cells);
    struct Data {
        Merged merged;
        graph::Buffer<std::uint32_t> photonOfCell;
        graph::Buffer<HierarchyNode> nodes;
    };
    return frame
        .pass<Data>(
            "driver.hierarchy", "photons that arrive together are stored as one",
            [&](graph::PassSetup& setup, Data& data) {
                hits.sample(setup);
                photons.sample(setup);
                setup.storage("Landings", landings);
                Merged& merged = data.merged;
                merged.hits = hits;
                merged.hits.flux =
                    setup.image("mergedFlux", setup.create<HitFlux>("hits.merged" + photons.suffix,
                                                                    photons.width, photons.height));
                if (photons.hasBeams()) {
                    Photons& own = merged.hits.incoming;
                    own.beamPlace = setup.image(
                        "mergedPlace", setup.create<BeamPlace>("photons.merged" + photons.suffix,
                                                               photons.width, photons.height));
                    own.beamTurn = setup.image(
                        "mergedTurn", setup.create<BeamTurn>("photons.spread" + photons.suffix,
                                                             photons.width, photons.height));
                }
                // Photons of several cells have no neighbours.
                if (params.tolerance > 0.0f) {
                    merged.hits.incoming.cells = {};
                    merged.hits.incoming.extents = {};
                }
                merged.counts = setup.storage("CellCounting", setup.write(counts));
                data.photonOfCell = setup.storage(
                    "CellPhotons",
                    setup.createBuffer<std::uint32_t>("hierarchy.photon_of_cell" + photons.suffix,
                                                      photons.cells.places()));
                data.nodes = setup.storage(
                    "HierarchyNodes",
                    setup.createBuffer<HierarchyNode>("hierarchy.nodes" + photons.suffix,
                                                      static_cast<std::size_t>(layout.nodes)));
            },
            [params, layout, list = photons](const Data& data, gl::PassContext& context) {
                context.buffer(data.photonOfCell).clear();
                gl::Command cells = context.compute("driver/hierarchical_cells.comp");
                setCells(cells, list.cells);
                dispatchOver(cells, list);
                for (int level = 1; level <= kLevels; ++level) {
                    const auto l = static_cast<std::size_t>(level);
                    gl::Command mip = context.compute("driver/hierarchical_mip.comp");
                    if (level == 1) mip.define("FROM_PHOTONS");
                    mip.set("sizeBelow", layout.sizes[l - 1])
                        .set("size", layout.sizes[l])
                        .set("first", layout.firsts[l])
                        .set("grids", layout.grids);
                    if (level > 1) mip.set("firstBelow", layout.firsts[l - 1]);
                    mip.dispatchOver(layout.sizes[l].x, 8, layout.sizes[l].y * layout.grids, 8);
                }
                gl::Command walk = context.compute("driver/hierarchical_walk.comp");
                setCells(walk, list.cells);
                walk.set("levels", kLevels).set("tolerance", params.tolerance);
                dispatchOver(walk, list);
            })
        .merged;
}

Caustic driveHierarchical(FrameBuilder& frame, const params::NoParams&, Surfaces surfaces) {
    const auto& params = frame.params<RefineParams>("refine");
    warnNothingJoined(frame);
    frame.skip("refine." + frame.inputs().params.choice(RefineStage::name),
               "every cell has its photon already");
    using Counts = graph::Buffer<transport::CellCounts>;
    Counts counts = frame.pass<Counts>(
        "driver.start", "nothing has been merged yet",
        [](graph::PassSetup& setup, Counts& data) {
            data = setup.createBuffer<transport::CellCounts>("hierarchy.counts", 1);
        },
        [](const Counts& data, gl::PassContext& context) { context.buffer(data).clear(); });
    Caustic caustic;
    // Whole squares; photons that stand for several cells are nobody's neighbours.
    const bool joins = params.tolerance <= 0.0f;
    for (const Samples& samples : batchesOfGrids(frame, 1 << kLevels, joins)) {
        PhotonUse use;
        use.arriving = [&](const Hits& hits) {
            const Merged merged = mergeArriving(frame, hits, surfaces, params, counts);
            counts = merged.counts;
            return merged.hits;
        };
        followPhotons(frame, surfaces, samples, caustic, use);
    }
    finishMedia(frame, caustic);
    caustic.cells = counts;
    return caustic;
}

}  // namespace

void registerDriverHierarchical(Registry& registry) {
    registry.node<DriverStage>(
        "hierarchical",
        {"Every photon of every light; those that arrive together are stored as one.",
         "W08, as WN09 describe it",
         "It needs photons of neighbouring cells, as emit=grid and emit=deferred make them, and "
         "refuses those that have none. Every photon is emitted and traced all the same: storing "
         "alone is saved.",
         {"refine.tolerance", "refine.metric"}},
        {.whyNoNeighbours = [](const FrameFacts& facts) -> std::string {
            if (facts.settings.get<RefineParams>(RefineStage::name).tolerance <= 0.0f) return "";
            return "photons of driver=hierarchical stand for several cells; with "
                   "refine.tolerance=0 they do not";
        }},
        &driveHierarchical);
}

}  // namespace kaustik
