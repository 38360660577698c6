// SPDX-License-Identifier: MIT
// What each light sees of the receivers: where its caustic map lies, and what is searched in its
// depths.
#pragma once

#include <vector>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// By light: one view of the receivers that its map covers (reconstruct.map_covers), orthographic
// for a sun, or, where a light with a place would need more than one, six faces around it.
// Specular objects hide nothing there. Made once a frame, by the first who asks.
[[nodiscard]] const std::vector<ReceiverView>& lightReceivers(FrameBuilder& frame,
                                                              const Geometry& geometry);

// By light: what reconstruct.map_cascades asks for besides, coarsest first: one view each of what
// the eye sees nearer by, in as many texels. None where it would be hardly finer.
[[nodiscard]] const std::vector<std::vector<ReceiverView>>& nearerReceivers(
    FrameBuilder& frame, const Geometry& geometry);

// Of the faces of so many cubes that store light: half of reconstruct.map_size, or what fits into
// reconstruct.map_memory.
[[nodiscard]] int sideOfCubeMaps(FrameBuilder& frame, int cubes);

}  // namespace kaustik
