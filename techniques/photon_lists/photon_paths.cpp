// SPDX-License-Identifier: MIT
#include "techniques/photon_lists/photon_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "framework/pipeline/ledger.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/generators/culling.h"
#include "techniques/photon_lists/branches.h"
#include "techniques/photon_lists/light_spread.h"

namespace kaustik {
namespace {

constexpr int kTextureRows = 16384;  // of which every device has as many

}  // namespace

int interactionCount(const FrameBuilder& frame, const ModelledPaths& paths) {
    if (paths.end) return 1;
    const scene::RepeatedHits& again = frame.needs().repeatedHits;
    const bool canRepeat = paths.transmissionOnly ? again.transmitted : again.reflected;
    return canRepeat ? frame.params<SpecularParams>("specular").bounces : 1;
}

std::vector<Samples> batchesOfGrids(const FrameBuilder& frame, int together, bool joins) {
    const int border = joins && frame.joinsCells() ? kJoinedRows : 0;
    if (border > 0) together = std::max(together, kJoinedSquare);
    // Lists have room for all that these may become.
    const int maximum = std::max(frame.params<EmitParams>("emit").batch >> branchLevels(frame), 1);
    const params::Extent photons = frame.photonsOfALight();
    const int lights = std::max(frame.needs().photonLights, 1);
    const int listRows = kTextureRows >> branchLevels(frame);
    const int maximumRows = std::max(std::min(maximum / photons.width, listRows), 1);
    std::vector<Samples> batches;
    const auto suffix = [&] {
        return batches.empty() ? "" : fmt::format(".{}", batches.size() + 1);
    };
    // As many whole grids as a list has room for, or parts of one.
    if (const int grids = maximumRows / photons.height; grids > 0) {
        for (int light = 0; light < lights; light += grids) {
            batches.push_back(
                {light, std::min(grids, lights - light), 0, photons.height, suffix(), {}});
        }
        return batches;
    }
    const int rows = std::max(maximumRows / together, 1) * together;
    for (int light = 0; light < lights; ++light) {
        for (int row = 0; row < photons.height; row += rows) {
            batches.push_back(
                {light, 1, row, std::min(rows, photons.height - row), suffix(), {}, {}, border});
        }
    }
    return batches;
}

void followPhotons(FrameBuilder& frame, const Surfaces& surfaces, Samples samples, Caustic& caustic,
                   const PhotonUse& use) {
    // Of a tile of the screen nothing is wanted but first hits.
    const bool isTile = frame.tile().has_value();
    const bool stores = use.stores && !isTile;
    const bool scatters = use.scatters && !isTile && frame.needs().scatteringMedium;
    if (use.stores) samples.ledger = caustic.map.ledger;
    Hits hits = spreadByLights(frame, frame.run<EmitStage>(surfaces, samples));
    int interactions = 1;
    for (int i = 0; i < interactions; ++i) {
        hits = endAtUnseen(frame, hits);
        const Photons photons = frame.run<SpecularStage>(hits, surfaces);
        interactions = interactionCount(frame, photons.paths);
        hits = frame.run<TraceStage>(photons, surfaces);
        if (isTile) caustic.map.ledger = hits.incoming.ledger;
        if (frame.endsTile(i + 1, interactions)) return;
        if (stores) {
            const Hits stored = use.arriving ? use.arriving(hits) : hits;
            caustic.map = frame.run<ReconstructStage>(stored, surfaces, caustic.map);
            hits.incoming.ledger = caustic.map.ledger;
        }
        if (scatters)
            caustic.inScattered = frame.run<MediaStage>(hits, surfaces.eye, caustic.inScattered);
    }
    if (!stores) return;
    // What is still on its way is counted at once, so that the batch need not be kept.
    caustic.map.ledger = closeBatch(frame, hits, caustic.map.ledger);
    caustic.last = hits;
}

void warnNothingJoined(FrameBuilder& frame) {
    const std::string reason = frame.facts().whyNoNeighbours();
    if (reason.empty() || !frame.joinsCells()) return;
    frame.warn(fmt::format("reconstruct={} joins nothing: {}.",
                           frame.inputs().params.choice(ReconstructStage::name), reason));
}

void finishMedia(FrameBuilder& frame, Caustic& caustic) {
    const std::string obstacle = whyNoScattering(frame.facts());
    if (obstacle.empty()) {
        caustic.inScattered = frame.run<BlurStage>(caustic.inScattered);
        return;
    }
    for (const char* stage : {MediaStage::name, BlurStage::name}) {
        frame.skip(std::string(stage) + "." + frame.chosenNode(stage).name, obstacle);
    }
}

}  // namespace kaustik
