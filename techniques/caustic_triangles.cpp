// SPDX-License-Identifier: MIT
#include "techniques/caustic_triangles/nodes.h"

namespace kaustik {

void registerCausticTriangles(Registry& registry) {
    registerAround(registry);
    registerSecant(registry);
    registerCubeGather(registry);
    registerAroundView(registry);
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
                        {}});
}

}  // namespace kaustik
