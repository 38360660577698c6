// SPDX-License-Identifier: MIT
#include "framework/pipeline/light.h"

namespace kaustik {

FluxMap FluxMap::deposit(graph::PassSetup& setup, const FluxMap& before, const ReceiverView& on,
                         const FluxSets& sets, const std::string& name) {
    FluxMap map = before;
    if (before.flux.valid()) {
        map.flux = setup.write(before.flux);
        setup.bypass(map.flux, before.flux);
        if (sets.counts) {
            map.counts = setup.write(before.counts);
            setup.bypass(map.counts, before.counts);
        }
    } else {
        map.sets = sets;
        map.on = on;
        const Views& views = on.views;
        map.flux = setup.create<FluxWord>(name, views->width(), views->height(),
                                          views->layers(map.wordsPerView()));
        setup.bypass(map.flux, {0, 0, 0, 0});
        if (sets.counts) {
            map.counts = setup.create<PhotonCountTexel>(
                name + "_counts", views->width(), views->height(), views->layers(sets.flux()));
            setup.bypass(map.counts, {0, 0, 0, 0});
        }
    }
    setup.image("fluxSums", map.flux);
    if (sets.counts) setup.image("photonCounts", map.counts);
    return map;
}

}  // namespace kaustik
