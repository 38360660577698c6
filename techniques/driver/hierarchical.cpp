// SPDX-License-Identifier: MIT
// driver.hierarchical: hierarchical caustic maps (W08, as WN09 describe them). All photons of the
// lights' grids are followed, as by the dense driver; over those that arrive with each tracing a
// mip map is built, of where they are and of their flux. A walk from its top goes down level by
// level, over lists without gaps of the squares of cells that hold photons: one whose light arrives
// within refine.tolerance texels is stored as one photon with all of its flux, of any other the
// squares below are listed. What comes out is a list without gaps of the photons that are stored.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "framework/core/error.h"
#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/light_cells/landing.h"
#include "techniques/light_cells/refine_stage.h"
#include "techniques/photon_lists/photon_paths.h"

namespace kaustik {
namespace {

// Squares of up to 64 cells a side are one photon, and lie in one batch.
constexpr int kMergedLevels = 6;
constexpr int kMaxLevels = static_cast<int>(transport::kSquareLevels) - 1;

// As shaders/driver/hierarchical.glsl and hierarchical_walk.glsl have them.
struct HierarchyNode {
    glm::vec2 low, high;
    glm::vec4 flux;
    std::uint32_t first, middle, state, signature;
};
struct WalkSquare {
    std::uint32_t node, first;
};
struct StoredPhoton {
    std::uint32_t photon, node, level;
};

// The squares of each level, for every light and branch, one level after the other, up to one
// square of each.
struct HierarchyLayout {
    std::array<glm::ivec2, kMaxLevels + 1> sizes{};
    std::array<int, kMaxLevels + 1> firsts{};
    int grids = 1;
    int levels = 0;
    int nodes = 0;
    HierarchyLayout(const CellGrid& cells) : grids(cells.lights << cells.splits) {
        sizes[0] = {cells.width, cells.rows};
        do {
            const glm::ivec2 below = sizes[static_cast<std::size_t>(levels)];
            ++levels;
            const auto l = static_cast<std::size_t>(levels);
            // Rows count from the grid's own first, so that batches share out whole squares.
            sizes[l] = {(below.x + 1) / 2, (below.y + 1) / 2};
            firsts[l] = nodes;
            nodes += squares(levels);
        } while (levels < kMaxLevels && sizeOf(levels) != glm::ivec2(1));
    }
    [[nodiscard]] const glm::ivec2& sizeOf(int level) const {
        return sizes[static_cast<std::size_t>(level)];
    }
    [[nodiscard]] int firstOf(int level) const { return firsts[static_cast<std::size_t>(level)]; }
    [[nodiscard]] int squares(int level) const { return sizeOf(level).x * sizeOf(level).y * grids; }
};

struct Merged {
    Hits hits;
    graph::Buffer<transport::CellCounts> counts;
};

// The mip map.
struct Pyramid {
    graph::Buffer<std::uint32_t> photonOfCell;
    graph::Buffer<HierarchyNode> nodes;
    graph::Buffer<std::uint32_t> stored;  // photons of each node's square
};

// What a level's squares and those below are, for its shaders.
gl::Command& setLevel(gl::Command& command, const HierarchyLayout& layout, int level,
                      float tolerance) {
    return command.set("sizeBelow", layout.sizeOf(level - 1))
        .set("size", layout.sizeOf(level))
        .set("first", layout.firstOf(level))
        .set("merges", level <= kMergedLevels ? 1 : 0)
        .set("tolerance", tolerance);
}

Pyramid buildPyramid(FrameBuilder& frame, const Hits& hits,
                     const graph::Buffer<light_cells::Landing>& landings,
                     const HierarchyLayout& layout, const RefineParams& params) {
    const Photons& photons = hits.incoming;
    return frame.pass<Pyramid>(
        "driver.hierarchy", "where photons of neighbouring cells arrive, square by square",
        [&](graph::PassSetup& setup, Pyramid& data) {
            hits.sample(setup);
            photons.sample(setup);
            setup.storage("Landings", landings);
            const auto nodes = static_cast<std::size_t>(layout.nodes);
            data.photonOfCell = setup.storage(
                "CellPhotons",
                setup.createBuffer<std::uint32_t>("hierarchy.photon_of_cell" + photons.suffix,
                                                  photons.cells.places()));
            data.nodes = setup.storage(
                "HierarchyNodes",
                setup.createBuffer<HierarchyNode>("hierarchy.nodes" + photons.suffix, nodes));
            data.stored = setup.storage(
                "HierarchyStored",
                setup.createBuffer<std::uint32_t>("hierarchy.stored" + photons.suffix, nodes));
        },
        [params, layout, list = photons](const Pyramid& data, gl::PassContext& context) {
            context.buffer(data.photonOfCell).clear();
            gl::Command cells = context.compute("driver/hierarchical_cells.comp");
            setCells(cells, list.cells);
            dispatchOver(cells, list);
            for (int level = 1; level <= layout.levels; ++level) {
                gl::Command mip = context.compute("driver/hierarchical_mip.comp");
                if (level == 1) mip.define("FROM_PHOTONS");
                setLevel(mip, layout, level, params.tolerance).set("grids", layout.grids);
                if (level == 1) {
                    mip.set("tellsPaths", params.signature == RefineSwitch::on ? 1 : 0);
                } else {
                    mip.set("firstBelow", layout.firstOf(level - 1));
                }
                mip.dispatchOver(layout.sizeOf(level).x, 8, layout.sizeOf(level).y * layout.grids,
                                 8);
            }
        });
}

// New textures and a new list for what is stored.
Hits createStored(graph::PassSetup& setup, const Hits& hits, bool mayMerge) {
    const Photons& photons = hits.incoming;
    const std::string suffix = photons.suffix + ".stored";
    Photons own =
        Photons::create(setup, photons.width, photons.height, suffix, {photons.hasBeams()});
    own.ledger = photons.ledger;
    own.paths = photons.paths;
    own.nextRows = photons.nextRows;
    own.batch = photons.batch;
    // Photons of several cells have no neighbours.
    if (!mayMerge) {
        own.cells = photons.cells;
        own.extents = photons.extents;
    }
    setup.image("storedPosition", own.position);
    setup.image("storedDirection", own.direction);
    setup.image("storedFlux", own.flux);
    setup.image("storedOrigin", own.origin);
    if (own.hasBeams()) {
        setup.image("storedPlace", own.beamPlace);
        setup.image("storedTurn", own.beamTurn);
    }
    setup.storage("StoredList", own.list);
    Hits stored;
    stored.incoming = own;
    stored.position =
        setup.image("storedHitPosition",
                    setup.create<HitPosition>("hits.position" + suffix, own.width, own.height));
    stored.surface =
        setup.image("storedHitSurface",
                    setup.create<HitSurface>("hits.surface" + suffix, own.width, own.height));
    stored.flux = setup.image("storedHitFlux",
                              setup.create<HitFlux>("hits.flux" + suffix, own.width, own.height));
    return stored;
}

Merged walkDown(FrameBuilder& frame, const Hits& hits, const Pyramid& pyramid,
                const HierarchyLayout& layout, const RefineParams& params,
                const graph::Buffer<transport::CellCounts>& counts) {
    struct Data {
        Merged merged;
        graph::Buffer<transport::PhotonList> lists;
        graph::Buffer<StoredPhoton> stored;
    };
    return frame
        .pass<Data>(
            "driver.walk", "photons that arrive together are stored as one",
            [&](graph::PassSetup& setup, Data& data) {
                const Photons& photons = hits.incoming;
                hits.sample(setup);
                photons.sample(setup);
                setup.storage("CellPhotons", pyramid.photonOfCell);
                setup.storage("HierarchyNodes", pyramid.nodes);
                setup.storage("HierarchyStored", pyramid.stored);
                data.merged.counts = setup.storage("CellCounting", setup.write(counts));
                data.merged.hits = createStored(setup, hits, params.tolerance > 0.0f);
                setup.storage("WalkSquares", setup.createBuffer<WalkSquare>(
                                                 "hierarchy.squares" + photons.suffix,
                                                 static_cast<std::size_t>(layout.nodes)));
                data.lists =
                    setup.storage("WalkLists", setup.createBuffer<transport::PhotonList>(
                                                   "hierarchy.lists" + photons.suffix,
                                                   static_cast<std::size_t>(layout.levels + 1)));
                data.stored = setup.storage(
                    "StoredPhotons",
                    setup.createBuffer<StoredPhoton>("hierarchy.stored_photons" + photons.suffix,
                                                     static_cast<std::size_t>(photons.capacity())));
            },
            [params, layout](const Data& data, gl::PassContext& context) {
                const Photons& own = data.merged.hits.incoming;
                context.compute("driver/hierarchical_top.comp")
                    .set("topSquares", layout.squares(layout.levels))
                    .set("top", layout.levels)
                    .set("first", layout.firstOf(layout.levels))
                    .set("rowLength", static_cast<unsigned>(own.width))
                    .dispatch(1);
                for (int level = layout.levels; level > 0; --level) {
                    context.compute("driver/hierarchical_level.comp")
                        .set("level", level)
                        .dispatch(1);
                    gl::Command walk = context.compute("driver/hierarchical_walk.comp");
                    setLevel(walk, layout, level, params.tolerance)
                        .set("level", level)
                        .set("firstBelow", level > 1 ? layout.firstOf(level - 1) : 0);
                    walk.dispatchIndirect(data.lists, static_cast<std::size_t>(level) *
                                                              sizeof(transport::PhotonList) +
                                                          offsetof(transport::PhotonList, groupsX));
                }
                // Of these squares a float still counts exactly.
                const int counted = std::min(layout.levels, kMergedLevels);
                context.compute("driver/hierarchical_counts.comp")
                    .set("squareCount", layout.squares(counted))
                    .set("first", layout.firstOf(counted))
                    .dispatch(1);
                for (const bool ofPhotons : {false, true}) {
                    gl::Command store = context.compute("driver/hierarchical_store.comp");
                    if (ofPhotons) store.define("PHOTONS");
                    dispatchOver(store, own);
                }
            })
        .merged;
}

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
    const Pyramid pyramid = buildPyramid(frame, hits, landings, layout, params);
    return walkDown(frame, hits, pyramid, layout, params, counts);
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
    for (const Samples& samples : batchesOfGrids(frame, 1 << kMergedLevels, joins)) {
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
         {"refine.tolerance", "refine.metric", "refine.signature"}},
        {.whyNoNeighbours = [](const FrameFacts& facts) -> std::string {
            if (facts.settings.get<RefineParams>(RefineStage::name).tolerance <= 0.0f) return "";
            return "photons of driver=hierarchical stand for several cells; with "
                   "refine.tolerance=0 they do not";
        }},
        &driveHierarchical);
}

}  // namespace kaustik
