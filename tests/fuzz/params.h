// SPDX-License-Identifier: MIT
// Parameters of every kind, in place of those of all techniques, which would have to be built.
#pragma once

#include "framework/params/field.h"

namespace kaustik::fuzz {

struct Params {
    bool isFast = false;
    int count = 4;
    float epsilonMeters = 0.01f;
    params::Extent photons{256, 256};
    template <class R>
    void reflect(R& r) {
        r.field(isFast, "fast", "Is it fast?");
        r.field(count, "count", "How many", "", params::range(1, 8));
        r.field(epsilonMeters, "epsilon", "How near is a hit", "m", params::range(1e-6f, 1.0f));
        r.field(photons, "photons", "Photons of the grid", "", params::range(1, 4096));
    }
};

}  // namespace kaustik::fuzz
