// SPDX-License-Identifier: MIT
// Nodes that trace rays through the scene's triangles instead of what a view shows of them.
#pragma once

#include "framework/pipeline/registry.h"

namespace kaustik {

void registerRaytraced(Registry& registry);

Hits traceRaytraced(FrameBuilder& frame, const params::NoParams&, Photons photons,
                    Surfaces surfaces);

}  // namespace kaustik
