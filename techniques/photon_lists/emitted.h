// SPDX-License-Identifier: MIT
// What the passes of all emitters have in common.
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// The cells of a batch: its own rows of each light's grid, and those next to them.
[[nodiscard]] CellGrid cellsOf(const Samples& samples, const params::Extent& grid);

// Declares that a pass makes these photons, of a batch, and their first hits, on specular surfaces;
// the ledger is that of the batches before, or a new one. Of a place of the list without a photon
// only the fates are defined, of the photon and of its hit: kFateNone. Where somebody keeps one of
// the textures all of them are whole.
[[nodiscard]] Hits storeEmitted(graph::PassSetup& setup, Photons photons, const Samples& samples);
// The first that such a pass does: a new ledger has nothing in it, and the list is full, unless
// the batch is of cells that another pass has listed.
void beginEmission(gl::PassContext& context, const Photons& photons, const Samples& samples);
// Whether somebody asks for one of their textures as such.
[[nodiscard]] bool isAnyKept(const gl::PassContext& context, const Hits& hits);
// Leaves every place of the list without a photon.
void clearEmitted(gl::PassContext& context, const Hits& hits);

}  // namespace kaustik
