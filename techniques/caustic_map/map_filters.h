// SPDX-License-Identifier: MIT
// What filters make of maps of flux.
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// The maps as some filter has left them in FluxMap::filtered, or as they were stored.
[[nodiscard]] CausticMap inFloats(FrameBuilder& frame, CausticMap map);

}  // namespace kaustik
