// SPDX-License-Identifier: MIT
// The receivers that views see, for whoever stores light there: see techniques/eye/surfaces.cpp.
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct SeenReceivers {
    ReceiverView receivers;
    graph::Texture<DepthBuffer> depth;  // reversed z; of a cube the last face's
    Geometry geometry;
};

// Adds the pass that draws them, as NAME.receiver, NAME.receiver_surface and NAME.receiver_albedo.
// `drawn`: with mirrors, or without what they hide.
[[nodiscard]] SeenReceivers renderReceivers(
    FrameBuilder& frame, Geometry geometry, const Views& views, const std::string& name,
    const std::string& reason, render::DrawSet drawn = render::DrawSet::nonDielectrics);

}  // namespace kaustik
