// SPDX-License-Identifier: MIT
// Shadows by rays, whoever traces them: from every receiver pixel one back to each light.
#pragma once

#include <functional>
#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

using RayTracing = std::function<Hits(Photons, Surfaces)>;

// Visibility, 0 or 1 a pixel and light; passes have the node's name behind "shadow.".
[[nodiscard]] Shadows shadowsByRays(FrameBuilder& frame, const std::string& name,
                                    const Geometry& geometry, const EyeBuffer& eye,
                                    const LayeredDepth& layers, const RayTracing& trace);

}  // namespace kaustik
