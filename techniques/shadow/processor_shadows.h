// SPDX-License-Identifier: MIT
// Shadows by Embree on all cores; there in builds with Embree alone.
#pragma once

#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// From every receiver that a pixel shows a ray back to each light, as shaders/shadow/bvh.comp sends
// them. What the pixels show is read back, and a bit of each is written to the device.
[[nodiscard]] Shadows shadowsByProcessor(FrameBuilder& frame, const std::string& pass,
                                         const Geometry& geometry, const EyeBuffer& eye);

}  // namespace kaustik
