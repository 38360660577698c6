// SPDX-License-Identifier: MIT
// Light beams between the vertices of a mesh of water (Watt 1990, W90), on flat receivers.
// As published: what water reflects is left out.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerDifferentialArea(Registry& registry) {
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
                        {{"specular", "interface"}}});
}

}  // namespace kaustik
