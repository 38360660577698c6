// SPDX-License-Identifier: MIT
// The nodes of stage `specular` that others choose between.
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

Photons interactAtInterface(FrameBuilder& frame, const params::NoParams&, Hits hits,
                            Surfaces surfaces);

struct SplitParams {
    int levels = 1;
    template <class R>
    void reflect(R& r) {
        r.field(levels, "levels",
                "Interactions at which both branches are followed, which doubles the transfer map; "
                "at later ones each photon takes one of them, drawn by its share",
                "", params::range(0, 6));
    }
};
Photons splitAtInterface(FrameBuilder& frame, const SplitParams& params, Hits hits,
                         Surfaces surfaces);

}  // namespace kaustik
