// SPDX-License-Identifier: MIT
// Squares of the eye's pixels, into which wide beams put their light until all of a frame's has
// come (shaders/reconstruct/triangles_pixel_blocks.glsl).
#pragma once

#include "framework/pipeline/frame_builder.h"
#include "techniques/stores/stores.h"

namespace kaustik {

// Declares that a pass puts light into those of the eye's view: those that the map before has, or
// new ones. What is given is for the map after it.
[[nodiscard]] graph::Buffer<PixelBlock> putIntoPixelBlocks(graph::PassSetup& setup,
                                                           const Store& store,
                                                           const FluxMap& before);
// The first thing that a pass with new ones does; `command` has the nodes' parameters and sees what
// the store's pixels show.
void makePixelBlocks(gl::Command command, const Store& store);

// What squares have of each map goes to their pixels, and what the processor has put into pixels to
// the map.
[[nodiscard]] CausticMap shareOutPixelBlocks(FrameBuilder& frame, CausticMap map);

}  // namespace kaustik
