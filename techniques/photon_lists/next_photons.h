// SPDX-License-Identifier: MIT
// The list of photons that go on from hits: those that have hit a specular surface, in their order
// and without gaps, found by a prefix scan (Blelloch 1990, "Prefix sums and their applications").
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct NextPhotons {
    Photons photons;
    graph::Buffer<std::uint32_t> firsts;  // by the workgroups of the list before
};

// Adds the pass "specular.list", which makes room for `branches` photons of each that goes on.
[[nodiscard]] NextPhotons allocateNext(FrameBuilder& frame, const Hits& hits, int branches);

// Declares that a pass sends photons on: what include/photons/next_photons.glsl reads and writes.
// Its commands have a thread a photon of `hits.incoming`.
[[nodiscard]] Photons bindNextPhotons(graph::PassSetup& setup, const Hits& hits,
                                      const NextPhotons& next);

}  // namespace kaustik
