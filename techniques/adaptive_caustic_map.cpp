// SPDX-License-Identifier: MIT
// Adaptive caustic maps: Wyman, Nichols 2009 (WN09). Its parts by section: papers.md.
// As published: buffers of a quarter of the map's resolution, between whose texels places and
// normals are interpolated; no search for what coarse cells miss, paths told apart by where they
// end alone; W05's estimates, and a body behind another one met as if light came straight from the
// light.
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
                         {"view", "image_space"}},
                        {{"emit.deferred.size", "256"},
                         {"emit.deferred.lookup", "interpolated"},
                         {"refine.mask", "off"},
                         {"refine.signature", "off"},
                         {"specular.deferred.distance", "estimates"},
                         {"specular.deferred.incidence", "light"},
                         {"trace.background.steps", "0"},
                         {"reconstruct.fixed.edges", "crossed"},
                         {"view.image_space.distance", "estimates"}}});
}

}  // namespace kaustik
