// SPDX-License-Identifier: MIT
// Screen-space photon tracing: Krüger, Bürger, Westermann 2006, "Interactive Screen-Space Accurate
// Photon Tracing on GPUs" (K06). Its parts by section: papers.md.
// As published: one line a photon, hits by an absolute distance, layers by peeling, whose number a
// reduction finds; one branch, one photon a cell, discs whose light falls linearly, shadow rays.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerScreenSpacePhotons(Registry& registry) {
    registry.technique({"screen_space_photons",
                        "Photon rays traced on the screen through a layered depth image.",
                        "Krüger, Bürger, Westermann 2006",
                        {{"layers", "auto"},
                         {"trace", "hierarchical"},
                         {"reconstruct", "triangles"},
                         {"view", "refraction"}},
                        {{"layers", "peel"},
                         {"layers.peel.counting", "reduce"},
                         {"shadow", "rays"},
                         {"emit.grid.subcells", "1"},
                         {"emit.grid.sight", "raster"},
                         {"specular", "interface"},
                         {"trace", "lines"},
                         {"trace.test", "epsilon"},
                         {"reconstruct", "sprites"},
                         {"reconstruct.sprites.shape", "disc"},
                         {"reconstruct.sprites.kernel", "linear"},
                         {"media.lines.width", "1"},
                         {"blur", "gaussian"},
                         {"view.refraction.search", "monotonic"},
                         {"view.refraction.stop", "depth"},
                         {"view.refraction.surfaces", "layers"}}});
}

}  // namespace kaustik
