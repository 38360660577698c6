// SPDX-License-Identifier: MIT
#include "techniques/planar/nodes.h"

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

void registerPlanar(Registry& registry) {
    registry.node<TraceStage>("plane",
                              {"Hits each photon's ray with the planes of flat receivers; no other "
                               "surface is seen.",
                               "K06, section 1.1, Fig. 2", Sees::flatReceivers},
                              &tracePlane);
    registry.technique({"planar",
                        "Photons hit flat receivers analytically and nothing else; else as "
                        "screen_space_photons.",
                        "K06, section 1.1, Fig. 2",
                        {{"layers", "auto"},
                         {"trace", "plane"},
                         {"reconstruct", "triangles"},
                         {"view", "refraction"}},
                        {}});
}

}  // namespace kaustik
