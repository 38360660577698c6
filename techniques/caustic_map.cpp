// SPDX-License-Identifier: MIT
// Caustic maps: Wyman, Davis 2006 (WD06). Its parts by section: papers.md.
// As published: W05's estimates of the distance inside, splats of 7 x 7 texels wherever they lie,
// and no search once the iteration has ended. It is also what WD08 compares with (Table 1).
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerCausticMap(Registry& registry) {
    registry.technique({"caustic_map",
                        "Photons as Gaussian splats of one size in each light's map, which is "
                        "projected onto the scene.",
                        "Wyman, Davis 2006 (WD06)",
                        {{"specular", "two_interfaces"},
                         {"trace", "background"},
                         {"reconstruct.space", "light"},
                         {"gather", "project"},
                         {"view", "image_space"},
                         {"emit.photons", "512x512"},
                         {"reconstruct", "fixed"}},
                        {{"emit.grid.subcells", "1"},
                         {"emit.grid.sight", "raster"},
                         {"specular.two_interfaces.distance", "estimates"},
                         {"trace.background.steps", "0"},
                         {"reconstruct.fixed.edges", "crossed"},
                         {"view.image_space.distance", "estimates"}}});
}

}  // namespace kaustik
