// SPDX-License-Identifier: MIT
#include "techniques/photon_lists/next_photons.h"

#include <fmt/format.h>

#include <algorithm>

namespace kaustik {
namespace {

// The shaders of a pass that may send on two photons of one are another variant.
const char* const kBranchVariant = "BRANCHES";

}  // namespace

NextPhotons allocateNext(FrameBuilder& frame, const Hits& hits, int levels) {
    return frame.pass<NextPhotons>(
        "specular.list", "photons that end leave no gaps",
        [&](graph::PassSetup& setup, NextPhotons& data) {
            const Photons& before = hits.incoming;
            hits.sample(setup);
            before.sample(setup);
            ModelledPaths paths = before.paths;
            ++paths.interactions;
            paths.insideBodies =
                frame.needs().closedDielectrics && !frame.traits<SpecularStage>().throughBodies;
            // What can part twice as many has at most once more room for it.
            CellGrid cells = before.cells;
            // A branch may have any of its numbers from the first parting on.
            cells.splits = std::max(cells.splits, levels);
            const int rows = before.nextRows << (paths.interactions <= levels ? 1 : 0);
            data.photons = Photons::create(setup, before.width, rows,
                                           fmt::format("{}_{}", before.batch, paths.interactions),
                                           before.extras());
            data.photons.batch = before.batch;
            data.photons.paths = paths;
            data.photons.cells = cells;
            data.photons.extents = before.extents;
            setup.storage("NextPhotons", data.photons.list);
            const auto groups =
                (static_cast<std::size_t>(before.capacity()) + transport::kPhotonGroup - 1) /
                transport::kPhotonGroup;
            data.firsts = setup.storage(
                "NextFirsts",
                setup.createBuffer<std::uint32_t>("photons.firsts" + data.photons.suffix, groups));
            if (levels == 0) return;
            data.parting = setup.storage(
                "NextParting",
                setup.createBuffer<glm::uvec2>("photons.parting" + data.photons.suffix, groups));
            setup.define(kBranchVariant);
        },
        [list = hits.incoming, levels](const NextPhotons& data, gl::PassContext& context) {
            gl::Command blocks = context.compute("photon_lists/next_photons_blocks.comp");
            if (levels > 0) blocks.set("branchesOfAll", 1u << static_cast<unsigned>(levels));
            dispatchOver(blocks, list);
            context.compute("photon_lists/next_photons_offsets.comp")
                .set("nextRowLength", data.photons.width)
                .dispatch(1);
        });
}

Photons bindNextPhotons(graph::PassSetup& setup, const Hits& hits, const NextPhotons& next) {
    hits.sample(setup);
    hits.incoming.sample(setup);
    setup.storage("NextFirsts", next.firsts);
    if (next.parting.valid()) {
        setup.storage("NextParting", next.parting);
        setup.define(kBranchVariant);
    }
    Photons photons = next.photons;
    photons.rewrite(setup);
    photons.store(setup);
    photons.ledger = hits.incoming.ledger;
    photons.account(setup);
    return photons;
}

}  // namespace kaustik
