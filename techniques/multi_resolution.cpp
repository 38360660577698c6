// SPDX-License-Identifier: MIT
// Splats of four sizes: Wyman, Dachsbacher 2008 (WD08), section 4.1. Its parts by section:
// papers.md.
// As published: as caustic_map is.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerMultiResolution(Registry& registry) {
    registry.technique({"multi_resolution",
                        "Splats of four sizes at once, of which each texel takes what its photons "
                        "are dense enough for.",
                        "Wyman, Dachsbacher 2008 (WD08), section 4.1",
                        {{"specular", "two_interfaces"},
                         {"trace", "background"},
                         {"reconstruct.space", "light"},
                         {"gather", "project"},
                         {"view", "image_space"},
                         {"emit.photons", "512x512"},
                         {"reconstruct", "four_radii"},
                         {"filter", "blend"}},
                        {{"emit.grid.subcells", "1"},
                         {"emit.grid.sight", "raster"},
                         {"specular.two_interfaces.distance", "estimates"},
                         {"trace.background.steps", "0"},
                         {"reconstruct.four_radii.edges", "crossed"},
                         {"view.image_space.distance", "estimates"}}});
}

}  // namespace kaustik
