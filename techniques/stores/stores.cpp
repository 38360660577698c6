// SPDX-License-Identifier: MIT
#include "techniques/stores/stores.h"

#include <fmt/format.h>

#include "framework/transport/primitives.h"
#include "techniques/generators/generators.h"
#include "techniques/raster_views/light_maps.h"
#include "techniques/raster_views/map_params.h"

namespace kaustik {
std::vector<Store> storesOf(FrameBuilder& frame, const Surfaces& surfaces) {
    const StoreSpace space = frame.params<ReconstructParams>("reconstruct").space;
    std::vector<Store> stores;
    if (space == StoreSpace::screen) {
        stores.emplace_back().receivers = surfaces.eye;
        return stores;
    }
    if (space == StoreSpace::cube) {
        const std::vector<ReceiverView>& seen = generatorReceivers(frame, surfaces.geometry);
        for (std::size_t generator = 0; generator < seen.size(); ++generator) {
            stores.push_back({seen[generator], -1, suffixOfGenerator(generator),
                              static_cast<int>(generator), &generatorsBlock(frame)});
        }
        return stores;
    }
    const std::vector<ReceiverView>& receivers = lightReceivers(frame, surfaces.geometry);
    const auto& nearer = nearerReceivers(frame, surfaces.geometry);
    for (std::size_t light = 0; light < receivers.size(); ++light) {
        const std::string suffix = light == 0 ? "" : fmt::format(".light_{}", light + 1);
        stores.push_back({receivers[light], static_cast<int>(light), suffix});
        for (std::size_t i = 0; i < nearer[light].size(); ++i) {
            Store& store = stores.emplace_back();
            store.receivers = nearer[light][i];
            store.light = static_cast<int>(light);
            store.suffix = fmt::format("{}.cascade_{}", suffix, i + 2);
            store.cascade = static_cast<int>(i) + 1;
        }
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
        stored.map.generator = stores[i].generator;
        stored.map.cascade = stores[i].cascade;
        if (stores[i].cascade == 0) hits.incoming.ledger = stored.ledger;
        map.maps.push_back(stored.map);
    }
    map.ledger = hits.incoming.ledger;
    return map;
}

FluxSets setsIn(const FrameBuilder& frame, const Store& store, SetLayout layout) {
    FluxSets sets;
    sets.layout = layout;
    // What goes to the eye only the eye's pixels know, and no texel that holds several of them.
    const bool hasLevels = layout == SetLayout::levels || layout == SetLayout::sharedLevels;
    if (frame.needs().glossyReceivers) {
        sets.glossy =
            store.isEyeView() && !hasLevels ? GlossySets::intensity : GlossySets::direction;
    }
    return sets;
}

void setDeposit(gl::Command& command, const FluxSets& sets) {
    if (sets.hasIntensity()) command.define("GLOSSY_RECEIVERS");
    if (sets.hasDirection()) command.define("MEAN_DIRECTION");
}

Stored depositIn(graph::PassSetup& setup, const Store& store, const Hits& hits,
                 const FluxMap& before, const FluxSets& sets) {
    hits.sample(setup);
    hits.incoming.sample(setup);
    setup.sample("receiver", store.receivers.receiver);
    setup.sample("receiverSurface", store.receivers.receiverSurface);
    if (sets.hasIntensity()) setup.sample("receiverAlbedo", store.receivers.receiverAlbedo);
    Stored stored;
    stored.isFirst = !before.flux.valid();
    stored.map =
        FluxMap::deposit(setup, before, store.receivers, sets, "caustic.flux" + store.suffix);
    if (store.cascade > 0) {
        // Never read: the light's first map has counted everything.
        stored.ledger = setup.storage(
            "LedgerEntries",
            setup.createBuffer<transport::LedgerEntry>(
                "ledger" + store.suffix + hits.incoming.suffix, transport::kLedgerEntryCount));
        setup.bypass(stored.ledger, {0, 0, 0, 0});
        return stored;
    }
    stored.ledger = setup.storage("LedgerEntries", setup.write(hits.incoming.ledger));
    setup.bypass(stored.ledger, hits.incoming.ledger);
    return stored;
}

void clearIfFirst(gl::PassContext& context, const Stored& stored) {
    if (!stored.isFirst || context.isRepeated()) return;
    context.texture(stored.map.flux).clear({0, 0, 0, 0});
    if (stored.map.sets.counts) context.texture(stored.map.counts).clear({0, 0, 0, 0});
}

gl::Command& bindStore(gl::Command& command, const Store& store) {
    store.receivers.views->bindTo(command);
    if (store.light >= 0) command.define("ONE_LIGHT").offer("lightOfMap", store.light);
    if (store.generator >= 0) {
        command.define("ONE_GENERATOR")
            .offer("generatorOfMap", store.generator)
            .offer("Generators", *store.generators);
    }
    return command;
}

}  // namespace kaustik
