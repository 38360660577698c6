// SPDX-License-Identifier: MIT
// refine.compute: which cells of a light's view become photons (WN09, sections 3.2.1 and 3.2.2).
// One thread a cell decides, a prefix scan keeps the order of both lists. In: the cells that were
// taken and their probes' hits; out: cells that wait and cells that are photons.
#include <cstdint>

#include "techniques/light_cells/refinement.h"

namespace kaustik {
namespace {

CellTraversal refineByCompute(FrameBuilder& frame, const params::NoParams&,
                              CellTraversal traversal) {
    const auto& params = frame.params<RefineParams>("refine");
    const TraversalSizes sizes = sizesOf(frame, params);
    const std::shared_ptr<SpecularMask> mask = specularMask(frame, params, traversal);
    const auto cells = static_cast<std::size_t>(sizes.round.capacity());
    return frame
        .pass<Refined>(
            "refine.compute", "cells are dropped, split, or become photons",
            [&](graph::PassSetup& setup, Refined& data) {
                declareRefinement(setup, data, traversal, params, mask);
                setup.storage("Decisions", setup.createBuffer<std::uint32_t>(
                                               "adaptive.decisions" + traversal.suffix, cells));
                setup.storage("GroupFirsts",
                              setup.createBuffer<glm::uvec2>("adaptive.firsts" + traversal.suffix,
                                                             (cells + 63) / 64));
            },
            [sizes](const Refined& data, gl::PassContext& context) {
                gl::Command decide = context.compute("refine/compute_decide.comp");
                setDecision(decide, data, sizes);
                overList(decide, data.traversal.taken);
                gl::Command offsets = context.compute("refine/compute_offsets.comp");
                setCapacity(offsets, sizes);
                offsets.dispatch(1);
                gl::Command place = context.compute("refine/compute_place.comp");
                overList(place, data.traversal.taken);
            })
        .traversal;
}

}  // namespace

void registerRefineCompute(Registry& registry) {
    registry.node<RefineStage>(
        "compute",
        {"Decides on every cell by a compute thread; a prefix scan keeps the order of cells and "
         "photons.",
         "WN09, sections 3.2.1 and 3.2.2",
         "It decides by where the probes of four quarters land: what lies between probes is not "
         "known to it. refine.finest bounds the levels; only driver=adaptive asks for it."},
        &refineByCompute);
}

}  // namespace kaustik
