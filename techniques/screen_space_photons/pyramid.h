// SPDX-License-Identifier: MIT
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// Adds the pass that makes `pyramid` of the other layers' textures.
[[nodiscard]] LayeredDepth addPyramid(FrameBuilder& frame, const LayeredDepth& layers);

}  // namespace kaustik
