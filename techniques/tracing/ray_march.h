// SPDX-License-Identifier: MIT
// The parameters of the tracers that follow a ray a pixel a step.
#pragma once

#include "framework/params/param_set.h"

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

}  // namespace kaustik
