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
    registry.technique({"differential_area",
                        "One photon a vertex of the water's mesh hits flat receivers analytically; "
                        "its irradiance is its flux over the area that the mesh's cells, bent by "
                        "the water, cover there.",
                        "differential areas of light beams: Watt 1990, on the mesh of the water",
                        {{"emit", "vertices"},
                         {"layers", "auto"},
                         {"trace", "plane"},
                         {"reconstruct", "triangles"},
                         {"view", "refraction"}},
                        {}});
}

}  // namespace kaustik
