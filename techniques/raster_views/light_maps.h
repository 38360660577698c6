// SPDX-License-Identifier: MIT
// What each light sees of the receivers: where its caustic map lies, and what is searched in its
// depths.
#pragma once

#include <vector>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// The views that light is stored in, for each light: one view of the receivers that its map covers
// (reconstruct.map_covers), orthographic for a sun, or six faces around a light with a place that
// would need more than one. Specular objects hide nothing there. Made once a frame, by the first
// node that asks.
[[nodiscard]] const std::vector<ReceiverView>& lightReceivers(FrameBuilder& frame,
                                                              const Geometry& geometry);

// The further views of each light that reconstruct.map_cascades asks for, coarsest first, in as
// many texels each: of what the eye sees nearer by, or of what it sees magnified (map_cascades_by).
// There is none where it would be hardly finer.
[[nodiscard]] const std::vector<std::vector<ReceiverView>>& nearerReceivers(
    FrameBuilder& frame, const Geometry& geometry);

// The side of the faces of so many cubes that store light: half of reconstruct.map_size, or what
// fits into reconstruct.map_memory.
[[nodiscard]] int sideOfCubeMaps(FrameBuilder& frame, int cubes);

}  // namespace kaustik
