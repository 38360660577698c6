// SPDX-License-Identifier: MIT
// Adds to a layered depth image a pyramid of planes, by which tracers skip what a ray cannot hit.
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// Adds the pass that makes `pyramid` of the other layers' textures, as NAME.pyramid.
[[nodiscard]] LayeredDepth addPyramid(FrameBuilder& frame, const LayeredDepth& layers,
                                      const std::string& name = "layers");

}  // namespace kaustik
