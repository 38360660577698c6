// SPDX-License-Identifier: MIT
// What of a box the eye looks at: for maps that hold no more than that.
#pragma once

#include "framework/render/view.h"

namespace kaustik {

struct SeenPart {
    scene::Bounds bounds;        // world space, m; empty where the eye sees nothing of the box
    double nearestMeters = 0.0;  // of depth in the eye's view
    double farthestMeters = 0.0;
};

// The part of `box` (world space, m) within the eye's frustum, as far as `farMeters` of depth.
[[nodiscard]] SeenPart seenPartOf(const scene::Bounds& box, const render::RasterView& eye,
                                  double farMeters = 1e30);

}  // namespace kaustik
