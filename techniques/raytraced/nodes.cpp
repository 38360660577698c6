// SPDX-License-Identifier: MIT
#include "techniques/raytraced/nodes.h"

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

void registerRaytraced(Registry& registry) {
    registry.node<TraceStage>(
        "raytraced",
        {"Exact first hits by ray tracing on the processor (Embree).", "", Sees::everything},
        &traceRaytraced);
    registry.technique({"raytraced",
                        "Every ray is traced exactly on the processor; else as "
                        "screen_space_photons.",
                        "",
                        {{"trace", "raytraced"}},
                        {}});
}

}  // namespace kaustik
