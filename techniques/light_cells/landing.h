// SPDX-License-Identifier: MIT
// Where photons arrive in the view that a metric of the stage refine looks from, whichever photons
// these are: probes of cells, or a grid's.
#pragma once

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/light_cells/refine_stage.h"

namespace kaustik {

// Ways in which one probe can land, where both branches of an interaction are followed.
constexpr int kMaxBranches = 4;

// What an entry of the buffer is of: a probe's light where it arrives, a photon's, or a probe's
// path through a medium, with both of its ends.
enum class LandingSource : int { probe, photon, path };

// Notes where these hits are, and what their photons have met. `branches`: entries of a probe.
[[nodiscard]] graph::Buffer<transport::Landing> findLandings(
    FrameBuilder& frame, const std::string& pass, graph::Buffer<transport::Landing> landings,
    const Hits& hits, const Surfaces& surfaces, RefineMetric metric, LandingSource source,
    int branches);

}  // namespace kaustik
