// SPDX-License-Identifier: MIT
// Finds where photons arrive in the view that a metric of the stage refine looks from, whichever
// photons these are: probes of cells, or a grid's.
#pragma once

#include <cstdint>
#include <string>

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/light_cells/refine_stage.h"

namespace kaustik {

// What an entry of the buffer is of: a probe's light where it arrives, a photon's, or a probe's
// path through a medium, with both of its ends.
enum class LandingSource : int { probe, photon, path };

// By place in a list: which probe its photon comes from. PhotonOrigin::cell does not say it: that
// is the cell's own number, by which photons and probes draw the same at random.
using ProbeNumbers = graph::Buffer<std::uint32_t>;

// Of the list of `hits`, by its photons' places in the list before, of which `before` is known;
// invalid: that list is the probes'. Adds a pass of this name.
[[nodiscard]] ProbeNumbers followProbes(FrameBuilder& frame, const std::string& pass,
                                        const ProbeNumbers& before, const Hits& hits);

// Notes where these hits are, and what their photons have met. `probes`: of their list, `branches`:
// entries of a probe; neither counts where an entry is a photon's.
[[nodiscard]] graph::Buffer<light_cells::Landing> findLandings(
    FrameBuilder& frame, const std::string& pass, graph::Buffer<light_cells::Landing> landings,
    const Hits& hits, const Surfaces& surfaces, RefineMetric metric, LandingSource source,
    const ProbeNumbers& probes = {}, int branches = 1);

}  // namespace kaustik
