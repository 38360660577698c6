// SPDX-License-Identifier: MIT
// Screen-space photon tracing: Krüger, Bürger, Westermann 2006, "Interactive Screen-Space Accurate
// Photon Tracing on GPUs" (K06). Its parts by section: papers.md.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerScreenSpacePhotons(Registry& registry) {
    registry.technique({"screen_space_photons",
                        "Photon rays traced on the screen through a layered depth image.",
                        "Krüger, Bürger, Westermann 2006",
                        {{"layers", "auto"},
                         {"trace", "hierarchical"},
                         {"reconstruct", "triangles"},
                         {"view", "refraction"}}});
}

}  // namespace kaustik
