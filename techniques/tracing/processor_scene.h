// SPDX-License-Identifier: MIT
// The scene as Embree traces it on the processor, for the passes of a frame; there in builds with
// Embree alone. Where water moves, a pass "geometry.embree" moves it to where the device has it,
// and fits the hierarchy anew.
#pragma once

#include <memory>

#include "framework/pipeline/frame_builder.h"
#include "framework/reference/embree_scene.h"

namespace kaustik {

// That the scene has moved, for whoever comes after it; it holds nothing.
using HasMoved = std::uint32_t;

struct ProcessorScene {
    std::shared_ptr<reference::EmbreeScene> scene;
    graph::Buffer<HasMoved> moved;  // invalid where nothing moves
    // Declares that a pass traces rays.
    void read(graph::PassSetup& setup) const;
};

[[nodiscard]] ProcessorScene processorScene(FrameBuilder& frame, const Geometry& geometry);

}  // namespace kaustik
