// SPDX-License-Identifier: MIT
// Nodes and techniques of caustic maps (WD06, WD08, SP05; W05's refraction).
#pragma once

#include "framework/pipeline/registry.h"

namespace kaustik {

void registerCausticMap(Registry& registry);

// One file each.
void registerTwoInterfaces(Registry& registry);
void registerBackground(Registry& registry);
void registerTexelSplats(Registry& registry);
void registerMapFilters(Registry& registry);
void registerProject(Registry& registry);

}  // namespace kaustik
