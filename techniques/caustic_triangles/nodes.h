// SPDX-License-Identifier: MIT
// Nodes and the technique of caustic triangles (U08).
#pragma once

#include "framework/pipeline/registry.h"

namespace kaustik {

void registerCausticTriangles(Registry& registry);

// One file each.
void registerAround(Registry& registry);
void registerSecant(Registry& registry);
void registerCubeGather(Registry& registry);
void registerAroundView(Registry& registry);

}  // namespace kaustik
