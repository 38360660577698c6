// SPDX-License-Identifier: MIT
// What lies around each caustic generator, for whoever searches rays there.
#pragma once

#include <vector>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// By generator (techniques/shared/generators.h), as stage `around` gives it. Made once a frame.
[[nodiscard]] const std::vector<SurfacesAround>& surfacesAround(FrameBuilder& frame,
                                                                const Geometry& geometry);

}  // namespace kaustik
