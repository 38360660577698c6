// SPDX-License-Identifier: MIT
// Adaptive caustic maps: Wyman, Nichols 2009 (WN09). Its parts by section: papers.md.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerAdaptiveCausticMap(Registry& registry) {
    registry.technique({"adaptive_caustic_map",
                        "As many photons as a map of light needs, cell by cell of each light's "
                        "view.",
                        "Wyman, Nichols 2009 (WN09)",
                        {{"driver", "adaptive"},
                         {"emit", "deferred"},
                         {"specular", "deferred"},
                         {"trace", "background"},
                         {"reconstruct", "fixed"},
                         {"reconstruct.space", "light"},
                         {"reconstruct.fixed.diameter", "3"},
                         {"gather", "project"},
                         {"view", "image_space"}}});
}

}  // namespace kaustik
