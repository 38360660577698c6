// SPDX-License-Identifier: MIT
#include "techniques/photon_lists/next_photons.h"

#include <fmt/format.h>

namespace kaustik {

NextPhotons allocateNext(FrameBuilder& frame, const Hits& hits, int branches) {
    return frame.pass<NextPhotons>(
        "specular.list", "photons that end leave no gaps",
        [&](graph::PassSetup& setup, NextPhotons& data) {
            const Photons& before = hits.incoming;
            hits.sample(setup);
            before.sample(setup);
            ModelledPaths paths = before.paths;
            ++paths.interactions;
            data.photons = Photons::create(setup, before.width, before.nextRows * branches,
                                           fmt::format("{}_{}", before.batch, paths.interactions),
                                           before.hasBeams());
            data.photons.batch = before.batch;
            data.photons.paths = paths;
            data.photons.cells = before.cells;
            data.photons.extents = before.extents;
            if (branches > 1) ++data.photons.cells.splits;
            setup.storage("NextPhotons", data.photons.list);
            const auto groups =
                (static_cast<std::size_t>(before.capacity()) + transport::kPhotonGroup - 1) /
                transport::kPhotonGroup;
            data.firsts = setup.storage(
                "NextFirsts",
                setup.createBuffer<std::uint32_t>("photons.firsts" + data.photons.suffix, groups));
        },
        [list = hits.incoming, branches](const NextPhotons& data, gl::PassContext& context) {
            dispatchOver(context.compute("photon_lists/next_photons_blocks.comp"), list);
            context.compute("photon_lists/next_photons_offsets.comp")
                .set("branches", branches)
                .set("nextRowLength", data.photons.width)
                .dispatch(1);
        });
}

Photons bindNextPhotons(graph::PassSetup& setup, const Hits& hits, const NextPhotons& next) {
    hits.sample(setup);
    hits.incoming.sample(setup);
    setup.storage("NextFirsts", next.firsts);
    Photons photons = next.photons;
    photons.rewrite(setup);
    photons.store(setup);
    photons.ledger = hits.incoming.ledger;
    photons.account(setup);
    return photons;
}

}  // namespace kaustik
