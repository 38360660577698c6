// SPDX-License-Identifier: MIT
// Splats on the screen: Wyman, Dachsbacher 2008 (WD08), section 3. Its parts by section:
// papers.md.
// As published: as caustic_map is.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerEyeGather(Registry& registry) {
    registry.technique({"eye_gather",
                        "Splats as wide as photons' beams straight on the screen, without a map.",
                        "Wyman, Dachsbacher 2008 (WD08), section 3",
                        {{"specular", "two_interfaces"},
                         {"trace", "background"},
                         {"reconstruct.space", "light"},
                         {"gather", "project"},
                         {"view", "image_space"},
                         {"emit.photons", "512x512"},
                         {"specular.two_interfaces.lens", "thin"},
                         {"reconstruct", "lens"},
                         {"reconstruct.space", "screen"},
                         {"gather", "screen"}},
                        {{"emit.grid.subcells", "1"},
                         {"emit.grid.sight", "raster"},
                         {"specular.two_interfaces.distance", "estimates"},
                         {"trace.background.steps", "0"},
                         {"reconstruct.lens.edges", "crossed"},
                         {"view.image_space.distance", "estimates"}}});
}

}  // namespace kaustik
