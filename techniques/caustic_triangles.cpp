// SPDX-License-Identifier: MIT
// Caustic triangles: Umenhoffer, Patow, Szirmay-Kalos 2008 (U08). Its parts by section: papers.md.
// As published: one branch, one photon a cell; triangles with a corner that has no photon are not
// drawn, and all light of a texel comes from the reference point.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerCausticTriangles(Registry& registry) {
    registry.technique({"caustic_triangles",
                        "Photons traced in layers of distance around each caustic generator; the "
                        "triangles between them store light on the faces of a cube there, which is "
                        "projected onto the scene.",
                        "Umenhoffer, Patow, Szirmay-Kalos 2008 (U08)",
                        {{"trace", "secant"},
                         {"reconstruct", "triangles"},
                         {"reconstruct.space", "cube"},
                         {"reconstruct.triangles.shading", "vertices"},
                         {"gather", "cube"},
                         {"view", "around"},
                         {"emit.photons", "128x128"}},
                        {{"emit.grid.subcells", "1"},
                         {"emit.grid.sight", "raster"},
                         {"specular", "interface"},
                         {"reconstruct.triangles.unjoined", "discard"},
                         {"gather.cube.incidence", "centre"}}});
}

}  // namespace kaustik
