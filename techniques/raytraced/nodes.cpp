// SPDX-License-Identifier: MIT
#include "techniques/raytraced/nodes.h"

namespace kaustik {

void registerRaytraced(Registry& registry) {
    registerExactTracing(registry);
    registry.technique({"raytraced",
                        "Every ray is traced exactly on the processor; else as "
                        "screen_space_photons.",
                        "",
                        {{"layers", "auto"}, {"trace", "raytraced"}, {"reconstruct", "triangles"}},
                        {}});
}

}  // namespace kaustik
