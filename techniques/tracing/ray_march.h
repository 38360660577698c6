// SPDX-License-Identifier: MIT
// Tracers that follow each photon's ray over the screen a pixel a step until the first hit (K06,
// section 2.1: what the paper compares its lines with), or skip squares of pixels whose layers it
// cannot hit. One fragment or one compute thread a photon; all give the same hits as trace.lines,
// whose steps and hit test they share. In: photons and layered depth in eye view space, m; out:
// hits, W that arrive after absorption.
#pragma once

#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct MarchParams {
    int steps = 0;
    int minimum = 4;
    template <class R>
    void reflect(R& r) {
        r.field(steps, "steps",
                "Most steps of a photon's ray; 0: as many as the longer side of the picture has "
                "pixels, so that no step skips one",
                "", params::range(0, 16384));
        r.field(minimum, "minimum",
                "Fewest steps of a ray, for rays almost parallel to the view direction", "",
                params::range(1, 64));
    }
};

// A node of stage `trace` that marches: "march", say, and its shader, which is one of fragments or
// one of threads.
struct RayMarch {
    std::string node;
    std::string shader;
    bool skipsSquares = false;  // by the pyramid of the layers
};
[[nodiscard]] Hits marchRays(FrameBuilder& frame, const RayMarch& march, const MarchParams& params,
                             const Photons& photons, const LayeredDepth& layers);

}  // namespace kaustik
