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
                        "Light beams between vertices of the water's mesh hit flat receivers "
                        "analytically: a vertex's irradiance is its flux over the area that the "
                        "cells around it cover there.",
                        "beams through a mesh of water: Watt 1990 (W90)",
                        {{"emit", "vertices"},
                         {"layers", "auto"},
                         {"trace", "plane"},
                         {"reconstruct", "triangles"},
                         {"view", "refraction"}},
                        {}});
}

}  // namespace kaustik
