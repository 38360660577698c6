// SPDX-License-Identifier: MIT
// Hierarchical caustic maps: Wyman 2008 (W08), as WN09 describe them. Its parts by section:
// papers.md.
// As published: one photon a cell of a grid, two interfaces by W05's estimates, no search once the
// iteration has ended, paths told apart by where they end alone, and a map of several resolutions,
// the coarser of which hold the photons that diverge, wherever their splats lie.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerHierarchicalCausticMap(Registry& registry) {
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
                        {{"emit", "grid"},
                         {"emit.grid.subcells", "1"},
                         {"emit.grid.sight", "raster"},
                         {"specular", "two_interfaces"},
                         {"specular.two_interfaces.distance", "estimates"},
                         {"trace.background.steps", "0"},
                         {"refine.signature", "off"},
                         {"reconstruct", "multi_level"},
                         {"reconstruct.multi_level.edges", "crossed"},
                         {"filter", "level_sum"},
                         {"view.image_space.distance", "estimates"}}});
}

}  // namespace kaustik
