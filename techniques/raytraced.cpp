// SPDX-License-Identifier: MIT
// The exact tracer in place of K06's: what the others are measured by.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerRaytraced(Registry& registry) {
    registry.technique(
        {"raytraced",
         "Every ray is traced exactly on the processor; else as "
         "screen_space_photons.",
         "",
         {{"layers", "auto"}, {"trace", "raytraced"}, {"reconstruct", "triangles"}}});
}

}  // namespace kaustik
