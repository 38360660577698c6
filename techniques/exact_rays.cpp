// SPDX-License-Identifier: MIT
// Exact rays on the device in place of K06's searches on the screen.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerExactRays(Registry& registry) {
    registry.technique({"exact_rays",
                        "Photons, the eye's rays, shadows and what pixels show where surfaces end "
                        "are traced exactly, on the device or, where that is the processor, by "
                        "Embree; else as screen_space_photons.",
                        "",
                        {{"layers", "auto"},
                         {"trace", "auto"},
                         {"reconstruct", "triangles"},
                         {"reconstruct.triangles.coverage", "samples"},
                         {"shadow", "bvh"},
                         {"view", "bvh"}}});
}

}  // namespace kaustik
