// SPDX-License-Identifier: MIT
#include "techniques/shared/stores.h"

#include <fmt/format.h>

#include "framework/pipeline/stage_params.h"
#include "techniques/shared/light_maps.h"

namespace kaustik {

std::vector<Store> storesOf(FrameBuilder& frame, const Surfaces& surfaces) {
    if (frame.params<ReconstructParams>("reconstruct").space == StoreSpace::screen)
        return {{surfaces.eye, -1, ""}};
    const std::vector<ReceiverView>& receivers = lightReceivers(frame, surfaces.geometry);
    std::vector<Store> stores;
    for (std::size_t light = 0; light < receivers.size(); ++light) {
        stores.push_back({receivers[light], static_cast<int>(light),
                          light == 0 ? "" : fmt::format(".light_{}", light + 1)});
    }
    return stores;
}

CausticMap storeEverywhere(FrameBuilder& frame, const Surfaces& surfaces, Hits hits,
                           const CausticMap& before, const Deposit& deposit) {
    CausticMap map;
    const std::vector<Store> stores = storesOf(frame, surfaces);
    for (std::size_t i = 0; i < stores.size(); ++i) {
        const FluxMap former = before.maps.empty() ? FluxMap{} : before.maps[i];
        Stored stored = deposit(stores[i], hits, former);
        stored.map.light = stores[i].light;
        hits.incoming.ledger = stored.ledger;
        map.maps.push_back(stored.map);
    }
    map.ledger = hits.incoming.ledger;
    return map;
}

FluxSets setsIn(const FrameBuilder& frame, const Store& store) {
    FluxSets sets;
    // What goes to the eye only the eye's pixels know.
    sets.hasIntensity = store.isEyes() && frame.needs().glossyReceivers;
    sets.hasDirection = !store.isEyes() && frame.needs().glossyReceivers;
    return sets;
}

void setDeposit(gl::Command& command, const FluxSets& sets) {
    if (sets.hasIntensity) command.define("GLOSSY_RECEIVERS");
    if (sets.hasDirection) command.define("MEAN_DIRECTION");
}

void takeLight(gl::Command& command, const Store& store) {
    if (store.light < 0) return;
    command.define("ONE_LIGHT").set("lightOfMap", store.light);
}

}  // namespace kaustik
