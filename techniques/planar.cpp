// SPDX-License-Identifier: MIT
// Flat receivers, met analytically: what was done before rays were traced on the screen (K06,
// section 1.1, Fig. 2).
// As published: one branch, one photon a cell, discs whose light falls linearly.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerPlanar(Registry& registry) {
    registry.technique({"planar",
                        "Photons hit flat receivers analytically and nothing else; else as "
                        "screen_space_photons.",
                        "K06, section 1.1, Fig. 2",
                        {{"layers", "auto"},
                         {"trace", "plane"},
                         {"reconstruct", "triangles"},
                         {"view", "refraction"}},
                        {{"emit.grid.subcells", "1"},
                         {"emit.grid.sight", "raster"},
                         {"specular", "interface"},
                         {"reconstruct", "sprites"},
                         {"reconstruct.sprites.shape", "disc"},
                         {"reconstruct.sprites.kernel", "linear"}}});
}

}  // namespace kaustik
