// SPDX-License-Identifier: MIT
// The list of photons that go on from hits: those that have hit a specular surface, in their order
// and without gaps, found by a prefix scan (Blelloch 1990, "Prefix sums and their applications").
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct NextPhotons {
    Photons photons;
    // By the workgroups of the list before.
    graph::Buffer<std::uint32_t> firsts;
    graph::Buffer<glm::uvec2> parting;  // bits: who sends on two; invalid where nobody does
};

// Adds the pass "specular.list", which makes room for one photon of each that goes on, or, where
// light parts and `levels` is more than 0, for two, as long as one emitted has become no more than
// 2^levels (include/photons/branches.glsl).
[[nodiscard]] NextPhotons allocateNext(FrameBuilder& frame, const Hits& hits, int levels = 0);

// Declares that a pass sends photons on: what include/photons/next_photons.glsl reads and writes.
// Its commands have a thread a photon of `hits.incoming`.
[[nodiscard]] Photons bindNextPhotons(graph::PassSetup& setup, const Hits& hits,
                                      const NextPhotons& next);

}  // namespace kaustik
