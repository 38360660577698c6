// SPDX-License-Identifier: MIT
// Nodes that trace rays through the scene's triangles instead of what a view shows of them.
#pragma once

#include "framework/pipeline/registry.h"

namespace kaustik {

void registerRaytraced(Registry& registry);

void registerExactTracing(Registry& registry);  // in its own file, trace.cpp

}  // namespace kaustik
