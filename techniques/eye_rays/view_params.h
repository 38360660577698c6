// SPDX-License-Identifier: MIT
// Parameters that all nodes of the stage view share (`view.param`).
#pragma once

#include "framework/params/field.h"

namespace kaustik {

struct ViewParams {
    int samples = 1;
    template <class R>
    void reflect(R& r) {
        r.field(samples, "samples",
                "Rays of the eye a pixel, evenly spread over it, whose mean is shown where one of "
                "them sees a specular surface; 1: through its middle. For each next to the middle "
                "the scene's first surfaces are drawn once more",
                "", params::range(1, 64));
    }
};

}  // namespace kaustik
