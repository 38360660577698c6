// SPDX-License-Identifier: MIT
// Caustic maps: Wyman, Davis 2006 (WD06). Its parts by section: papers.md.
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
                         {"reconstruct", "fixed"}}});
}

}  // namespace kaustik
