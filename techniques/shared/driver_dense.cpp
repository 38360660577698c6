// SPDX-License-Identifier: MIT
// driver.dense: every photon of every light, in batches no larger than emit.batch, from
// interaction to interaction: what arrives is stored at once, and what reaches another specular
// surface is the next list. In: surfaces; out: the map of flux, W, and in-scattered light.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/ledger.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/shared/nodes.h"

namespace kaustik {
namespace {

// A path through still water hits it once. Where one can come back, the limit decides, and the
// ledger says what it cost.
int interactionCount(const FrameBuilder& frame, const ModelledPaths& paths) {
    if (paths.end) return 1;
    const scene::HitsAgain& again = frame.needs().hitsAgain;
    const bool canRepeat = paths.transmissionOnly ? again.transmitted : again.reflected;
    return canRepeat ? frame.params<SpecularParams>("specular").bounces : 1;
}

// All photons at once, or, where they are more than a batch may hold, whole rows of one light's
// photons after the other.
std::vector<Samples> batchesOf(const FrameBuilder& frame) {
    const int most = frame.params<EmitParams>("emit").batch;
    const params::Extent photons = frame.photonsOfALight();
    const int lights = std::max(frame.needs().lights, 1);
    const std::int64_t all = std::int64_t{photons.width} * photons.height * lights;
    if (all <= most) return {{0, lights, 0, photons.height, "", {}}};
    const int rows = std::clamp(most / photons.width, 1, photons.height);
    std::vector<Samples> batches;
    for (int light = 0; light < lights; ++light) {
        for (int row = 0; row < photons.height; row += rows) {
            const std::string suffix =
                batches.empty() ? "" : fmt::format(".{}", batches.size() + 1);
            batches.push_back({light, 1, row, std::min(rows, photons.height - row), suffix, {}});
        }
    }
    return batches;
}

Caustic followAllPhotons(FrameBuilder& frame, const params::NoParams&, Surfaces surfaces) {
    const bool scatters = frame.needs().scatteringMedium;
    Caustic caustic;
    for (Samples samples : batchesOf(frame)) {
        samples.ledger = caustic.map.ledger;
        Hits hits = frame.run<EmitStage>(surfaces, samples);
        int interactions = 1;
        for (int i = 0; i < interactions; ++i) {
            const Photons photons = frame.run<SpecularStage>(hits, surfaces);
            interactions = interactionCount(frame, photons.paths);
            hits = frame.run<TraceStage>(photons, surfaces);
            caustic.map = frame.run<ReconstructStage>(hits, surfaces, caustic.map);
            hits.incoming.ledger = caustic.map.ledger;
            if (scatters) {
                caustic.inScattered =
                    frame.run<MediaStage>(hits, surfaces.eye, caustic.inScattered);
            }
        }
        // What is still on its way is counted at once, so that the batch need not be kept.
        caustic.map.ledger = closeBatch(frame, hits, caustic.map.ledger);
        caustic.last = hits;
    }
    if (scatters) {
        caustic.inScattered = frame.run<BlurStage>(caustic.inScattered);
    } else {
        for (const char* stage : {MediaStage::name, BlurStage::name}) {
            frame.skip(std::string(stage) + "." + frame.chosenNode(stage).name,
                       "the scene has no medium that scatters");
        }
    }
    return caustic;
}

}  // namespace

void registerDenseDriver(Registry& registry) {
    registry.node<DriverStage>(
        "dense",
        {"Every photon of every light, from interaction to interaction.", "K06, section 2.3"},
        &followAllPhotons);
}

}  // namespace kaustik
