// SPDX-License-Identifier: MIT
#include "techniques/adaptive_caustic_map/nodes.h"

namespace kaustik {

void registerAdaptiveCausticMap(Registry& registry) {
    registerDeferredEmission(registry);
    registerDeferredSpecular(registry);
    registerDeferredView(registry);
    registerAdaptiveDriver(registry);
    registerHierarchicalDriver(registry);
    registerRefinement(registry);
    registry.technique({"hierarchical_caustic_map",
                        "All photons of a grid, of which those that arrive together are stored as "
                        "one.",
                        "Wyman 2008 (W08), as WN09 describe it",
                        {{"driver", "hierarchical"},
                         {"emit", "deferred"},
                         {"emit.photons", "512x512"},
                         {"specular", "deferred"},
                         {"trace", "background"},
                         {"reconstruct", "fixed"},
                         {"reconstruct.space", "light"},
                         {"reconstruct.fixed.diameter", "3"},
                         {"gather", "project"},
                         {"view", "image_space"}},
                        {}});
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
                        {}});
}

}  // namespace kaustik
