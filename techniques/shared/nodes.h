// SPDX-License-Identifier: MIT
// Nodes that every technique may use. Each is registered by its own file, with its parameters.
#pragma once

#include "framework/pipeline/registry.h"

namespace kaustik {

// All of them but the one that leaves in-scattered light out: that comes after those that make it,
// of which the first is the stage's default.
void registerSharedNodes(Registry& registry);
void registerNoMedia(Registry& registry);

void registerHeightField(Registry& registry);
void registerEyeSurfaces(Registry& registry);
void registerDenseDriver(Registry& registry);
void registerGridEmission(Registry& registry);
void registerVertexEmission(Registry& registry);
void registerSpecularAuto(Registry& registry);
void registerSpecularInterface(Registry& registry);
void registerSpecularSplit(Registry& registry);
void registerShadowMap(Registry& registry);
void registerNoFilter(Registry& registry);
void registerScreenGather(Registry& registry);
void registerNoTemporal(Registry& registry);
void registerTemporalReprojection(Registry& registry);
void registerNoBlur(Registry& registry);
void registerInterfaceView(Registry& registry);
void registerPicture(Registry& registry);

}  // namespace kaustik
