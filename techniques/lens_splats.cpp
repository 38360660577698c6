// SPDX-License-Identifier: MIT
// Splats as wide as a thin lens makes photons' beams: Wyman, Dachsbacher 2008 (WD08), section 4.2.
// Its parts by section: papers.md.
// As published: as caustic_map is.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerLensSplats(Registry& registry) {
    registry.technique({"lens_splats",
                        "Splats as wide as a thin lens of the refractor's curvatures makes each "
                        "photon's beam.",
                        "Wyman, Dachsbacher 2008 (WD08), section 4.2",
                        {{"specular", "two_interfaces"},
                         {"trace", "background"},
                         {"reconstruct.space", "light"},
                         {"gather", "project"},
                         {"view", "image_space"},
                         {"emit.photons", "512x512"},
                         {"specular.two_interfaces.lens", "thin"},
                         {"reconstruct", "lens"}},
                        {{"emit.grid.subcells", "1"},
                         {"emit.grid.sight", "raster"},
                         {"specular.two_interfaces.distance", "estimates"},
                         {"trace.background.steps", "0"},
                         {"reconstruct.lens.edges", "crossed"},
                         {"view.image_space.distance", "estimates"}}});
}

}  // namespace kaustik
