// SPDX-License-Identifier: MIT
// Screen-space photon tracing: Krüger, Bürger, Westermann 2006, "Interactive Screen-Space Accurate
// Photon Tracing on GPUs" (K06). Each node is registered by its own file, with its parameters.
#pragma once

#include "framework/pipeline/registry.h"

namespace kaustik {

// The technique and all of its nodes.
void registerScreenSpacePhotons(Registry& registry);

void registerPeel(Registry& registry);
void registerPeelObjects(Registry& registry);
void registerLists(Registry& registry);
void registerLines(Registry& registry);
void registerMarch(Registry& registry);  // four nodes: hierarchically or not, fragments or threads
void registerAllHits(Registry& registry);
void registerShadowRays(Registry& registry);
void registerSprites(Registry& registry);
void registerTriangles(Registry& registry);
void registerGodRays(Registry& registry);
void registerGaussianBlur(Registry& registry);
void registerRefraction(Registry& registry);
void registerImageSpace(Registry& registry);

}  // namespace kaustik
