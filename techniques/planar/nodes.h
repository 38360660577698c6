// SPDX-License-Identifier: MIT
// Nodes that know the receivers as planes (K06, section 1.1).
#pragma once

#include "framework/pipeline/registry.h"

namespace kaustik {

void registerPlanar(Registry& registry);

Hits tracePlane(FrameBuilder& frame, const params::NoParams&, Photons photons, Surfaces surfaces);

}  // namespace kaustik
