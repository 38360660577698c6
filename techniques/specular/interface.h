// SPDX-License-Identifier: MIT
// The function of the node specular.interface, for nodes that choose between it and another one.
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// specular.interface, for who chooses between it and another node.
Photons interactAtInterface(FrameBuilder& frame, const params::NoParams&, Hits hits,
                            Surfaces surfaces);

}  // namespace kaustik
