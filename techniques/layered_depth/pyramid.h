// SPDX-License-Identifier: MIT
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// Adds the pass that makes `pyramid` of the other layers' textures, as NAME.pyramid.
[[nodiscard]] LayeredDepth addPyramid(FrameBuilder& frame, const LayeredDepth& layers,
                                      const std::string& name = "layers");

}  // namespace kaustik
