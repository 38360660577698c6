// SPDX-License-Identifier: MIT
// What drivers do with the photons that they have chosen.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// How often photons may interact. A path through still water hits it once. Where one can come back,
// the limit decides, and the ledger says what it cost.
[[nodiscard]] int interactionCount(const FrameBuilder& frame, const ModelledPaths& paths);

// All photons of the lights' grids at once, or, where they are more than a batch may hold, whole
// rows of one light's after the other. `together`: so many rows from the grid's first on are in one
// batch, whatever emit.batch says. `joins`: a reconstruction that joins neighbouring cells is given
// those next to a batch as well, and whole squares of them.
[[nodiscard]] std::vector<Samples> batchesOfGrids(const FrameBuilder& frame, int together = 1,
                                                  bool joins = true);

// What photons are followed for.
struct PhotonUse {
    bool stores = true;    // light that arrives
    bool scatters = true;  // light in a medium, where the scene has one
    // Makes of hits those that are stored.
    std::function<Hits(const Hits&)> arriving = {};
};

// Emits these samples and follows them from interaction to interaction: what arrives, or is
// scattered, is added to `caustic` at once. Photons that are stored have the ledger of `caustic`'s
// map, others that of the samples, which are not read.
void followPhotons(FrameBuilder& frame, const Surfaces& surfaces, Samples samples, Caustic& caustic,
                   const PhotonUse& use = {});

// Warns where a reconstruction is to join neighbouring photons, and those of this driver have none.
void warnNothingJoined(FrameBuilder& frame);

// After the last photons: smooths what a medium scatters, or says why there is none.
void finishMedia(FrameBuilder& frame, Caustic& caustic);

}  // namespace kaustik
