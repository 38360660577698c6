// SPDX-License-Identifier: MIT
#include "framework/transport/stages.h"

#include "framework/render/raster_views.h"

namespace kaustik {

Photons Photons::create(graph::PassSetup& setup, int width, int height, const std::string& suffix) {
    Photons photons;
    photons.width = width;
    photons.height = height;
    photons.rowsThatGoOn = height;
    photons.suffix = suffix;
    photons.position = setup.create<PhotonPosition>("photons.position" + suffix, width, height);
    photons.direction = setup.create<PhotonDirection>("photons.direction" + suffix, width, height);
    photons.flux = setup.create<PhotonFlux>("photons.flux" + suffix, width, height);
    photons.origin = setup.create<OriginTexel>("photons.origin" + suffix, width, height);
    photons.list = setup.createBuffer<transport::PhotonList>("photons.list" + suffix, 1);
    return photons;
}

void Photons::sample(graph::PassSetup& setup) const {
    setup.sample("photonPosition", position);
    setup.sample("photonDirection", direction);
    setup.sample("photonFlux", flux);
    setup.sample("photonOrigin", origin);
    setup.storage("Photons", list);
}

void Photons::store(graph::PassSetup& setup, const std::string& prefix,
                    const std::string& block) const {
    setup.image(prefix + "Position", position);
    setup.image(prefix + "Direction", direction);
    setup.image(prefix + "Flux", flux);
    setup.image(prefix + "Origin", origin);
    setup.storage(block, list);
}

void Photons::account(graph::PassSetup& setup) {
    ledger = setup.storage("LedgerEntries", setup.write(ledger));
}

Hits Hits::create(graph::PassSetup& setup, const Photons& incoming) {
    Hits hits;
    hits.incoming = incoming;
    const std::string& suffix = incoming.suffix;
    hits.position =
        setup.create<HitPosition>("hits.position" + suffix, incoming.width, incoming.height);
    hits.surface =
        setup.create<HitSurface>("hits.surface" + suffix, incoming.width, incoming.height);
    hits.flux = setup.create<HitFlux>("hits.flux" + suffix, incoming.width, incoming.height);
    return hits;
}

void Hits::sample(graph::PassSetup& setup) const {
    setup.sample("hitPosition", position);
    setup.sample("hitSurface", surface);
    setup.sample("hitFlux", flux);
}

void Hits::store(graph::PassSetup& setup) const {
    setup.image("hitPosition", position);
    setup.image("hitSurface", surface);
    setup.image("hitFlux", flux);
}

CausticMap CausticMap::deposit(graph::PassSetup& setup, const CausticMap& before,
                               const Views& views, bool hasIntensity, const std::string& name) {
    CausticMap map = before;
    if (before.flux.valid()) {
        map.flux = setup.write(before.flux);
        setup.bypass(map.flux, before.flux);
    } else {
        map.hasIntensity = hasIntensity;
        map.views = views;
        map.flux = setup.create<FluxWord>(name, views->width(), views->height(),
                                          views->layers(map.wordsPerView()));
        setup.bypass(map.flux, {0, 0, 0, 0});
    }
    setup.image("fluxSums", map.flux);
    return map;
}

}  // namespace kaustik
