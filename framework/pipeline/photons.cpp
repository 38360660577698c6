// SPDX-License-Identifier: MIT
#include "framework/pipeline/photons.h"

namespace kaustik {
namespace {

// The shaders of a pass that handles beams are another variant.
const char* const kBeamVariant = "PHOTON_BEAMS";
const char* const kSpreadVariant = "LIGHT_SPREAD";

}  // namespace

Photons Photons::create(graph::PassSetup& setup, int width, int height, const std::string& suffix,
                        PhotonExtras extras, const LightCells& cells) {
    Photons photons;
    photons.width = width;
    photons.height = height;
    photons.nextRows = height;
    photons.suffix = suffix;
    photons.position = setup.create<PhotonPosition>("photons.position" + suffix, width, height);
    photons.direction = setup.create<PhotonDirection>("photons.direction" + suffix, width, height);
    photons.flux = setup.create<PhotonFlux>("photons.flux" + suffix, width, height);
    photons.origin = setup.create<OriginTexel>("photons.origin" + suffix, width, height);
    if (extras.beams) {
        photons.beamPlace = setup.create<BeamPlace>("photons.place" + suffix, width, height);
        photons.beamTurn = setup.create<BeamTurn>("photons.turn" + suffix, width, height);
    }
    if (extras.lightSpread) photons.createSpread(setup);
    photons.list = cells.valid()
                       ? cells.list
                       : setup.createBuffer<transport::PhotonList>("photons.list" + suffix, 1);
    return photons;
}

void Photons::createSpread(graph::PassSetup& setup) {
    spreadPlace = setup.create<BeamPlace>("photons.spread_place" + suffix, width, height);
    spreadTurn = setup.create<BeamTurn>("photons.spread_turn" + suffix, width, height);
}

void Photons::sample(graph::PassSetup& setup) const {
    setup.sample("photonPosition", position);
    setup.sample("photonDirection", direction);
    setup.sample("photonFlux", flux);
    setup.sample("photonOrigin", origin);
    setup.storage("Photons", list);
    if (!hasBeams()) return;
    setup.sample("photonBeamPlace", beamPlace);
    setup.sample("photonBeamTurn", beamTurn);
    setup.define(kBeamVariant);
    if (!hasLightSpread()) return;
    setup.sample("photonSpreadPlace", spreadPlace);
    setup.sample("photonSpreadTurn", spreadTurn);
    setup.define(kSpreadVariant);
}

void Photons::store(graph::PassSetup& setup) const {
    setup.image("nextPosition", position);
    setup.image("nextDirection", direction);
    setup.image("nextFlux", flux);
    setup.image("nextOrigin", origin);
    setup.storage("NextPhotons", list);
    if (!hasBeams()) return;
    setup.image("nextBeamPlace", beamPlace);
    setup.image("nextBeamTurn", beamTurn);
    setup.define(kBeamVariant);
    if (!hasLightSpread()) return;
    setup.image("nextSpreadPlace", spreadPlace);
    setup.image("nextSpreadTurn", spreadTurn);
    setup.define(kSpreadVariant);
}

void Photons::rewrite(graph::PassSetup& setup) {
    position = setup.write(position);
    direction = setup.write(direction);
    flux = setup.write(flux);
    origin = setup.write(origin);
    if (!hasBeams()) return;
    beamPlace = setup.write(beamPlace);
    beamTurn = setup.write(beamTurn);
    if (!hasLightSpread()) return;
    spreadPlace = setup.write(spreadPlace);
    spreadTurn = setup.write(spreadTurn);
}

std::vector<graph::ResourceRef> Photons::textures() const {
    std::vector<graph::ResourceRef> all{position, direction, flux, origin};
    if (hasBeams()) all.insert(all.end(), {beamPlace, beamTurn});
    if (hasLightSpread()) all.insert(all.end(), {spreadPlace, spreadTurn});
    return all;
}

void Photons::account(graph::PassSetup& setup) {
    ledger = setup.storage("LedgerEntries", setup.write(ledger));
}

Hits Hits::create(graph::PassSetup& setup, const Photons& incoming) {
    Hits hits;
    hits.incoming = incoming;
    const std::string& suffix = incoming.suffix;
    const int w = incoming.width;
    const int h = incoming.height;
    hits.position = setup.create<HitPosition>("hits.position" + suffix, w, h);
    hits.surface = setup.create<HitSurface>("hits.surface" + suffix, w, h);
    hits.flux = setup.create<HitFlux>("hits.flux" + suffix, w, h);
    if (incoming.hasBeams()) {
        hits.shape = setup.create<HitShape>("hits.shape" + suffix, w, h);
        setup.define(kBeamVariant);
    }
    return hits;
}

void Hits::sample(graph::PassSetup& setup) const {
    setup.sample("hitPosition", position);
    setup.sample("hitSurface", surface);
    setup.sample("hitFlux", flux);
    if (!shape.valid()) return;
    setup.sample("hitShape", shape);
    setup.define(kBeamVariant);
}

void Hits::store(graph::PassSetup& setup) const {
    setup.image("hitPosition", position);
    setup.image("hitSurface", surface);
    setup.image("hitFlux", flux);
    if (shape.valid()) setup.image("hitShape", shape);
}

void Hits::rewrite(graph::PassSetup& setup) {
    position = setup.write(position);
    surface = setup.write(surface);
    flux = setup.write(flux);
    if (!shape.valid()) return;
    shape = setup.write(shape);
    setup.define(kBeamVariant);
}

std::vector<graph::ResourceRef> Hits::textures() const {
    std::vector<graph::ResourceRef> all{position, surface, flux};
    if (shape.valid()) all.push_back(shape);
    return all;
}

}  // namespace kaustik
