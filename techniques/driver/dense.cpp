// SPDX-License-Identifier: MIT
// driver.dense: every photon of every light, in batches no larger than emit.batch, from
// interaction to interaction: what arrives is stored at once, and what reaches another specular
// surface is the next list. In: surfaces; out: the map of flux, W, and in-scattered light.
#include "framework/pipeline/frame_builder.h"
#include "techniques/photon_lists/photon_paths.h"

namespace kaustik {
namespace {

Caustic driveDense(FrameBuilder& frame, const params::NoParams&, Surfaces surfaces) {
    Caustic caustic;
    for (const Samples& samples : batchesOfGrids(frame))
        followPhotons(frame, surfaces, samples, caustic);
    if (!frame.tile()) finishMedia(frame, caustic);
    return caustic;
}

}  // namespace

void registerDriverDense(Registry& registry) {
    registry.node<DriverStage>(
        "dense",
        {"Every photon of every light, from interaction to interaction.", "K06, section 2.3",
         "It follows as many photons as the emitter makes, wherever their light goes: no more "
         "where "
         "it converges, and no fewer where the eye sees nothing of it."},
        {.tiles = true}, &driveDense);
}

}  // namespace kaustik
