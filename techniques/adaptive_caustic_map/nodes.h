// SPDX-License-Identifier: MIT
#pragma once

#include "framework/pipeline/registry.h"

namespace kaustik {

// The family's nodes and techniques.
void registerAdaptiveCausticMap(Registry& registry);

void registerDeferredEmission(Registry& registry);
void registerDeferredSpecular(Registry& registry);
void registerDeferredView(Registry& registry);
void registerAdaptiveDriver(Registry& registry);
void registerHierarchicalDriver(Registry& registry);
void registerRefinement(Registry& registry);

}  // namespace kaustik
