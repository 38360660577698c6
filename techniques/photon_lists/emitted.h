// SPDX-License-Identifier: MIT
// What the passes of all emitters have in common.
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// Declares that a pass makes these photons, of a batch, and their first hits, on specular surfaces;
// the ledger is that of the batches before, or a new one.
[[nodiscard]] Hits storeEmitted(graph::PassSetup& setup, Photons photons, const Samples& samples);
// The first that such a pass does: a new ledger has nothing in it, and the list is full, unless
// the batch is of cells that somebody else has listed.
void beginEmission(gl::PassContext& context, const Photons& photons, const Samples& samples);
// Leaves nobody in any place of the list.
void clearEmitted(gl::PassContext& context, const Hits& hits);

}  // namespace kaustik
