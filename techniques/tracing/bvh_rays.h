// SPDX-License-Identifier: MIT
// The hierarchy of the scene for whoever traces rays through it (include/surfaces/bvh.glsl): as it
// was built, or, where there are height fields, with their corners and all bounds made anew once a
// frame.
#pragma once

#include "framework/pipeline/frame_builder.h"
#include "framework/transport/bvh.h"

namespace kaustik {

struct BvhNodeBounds {
    glm::vec4 lower;
    glm::vec4 upper;
};

// The hierarchy as it is in this frame; the handles are invalid where nothing moves.
struct BvhOfFrame {
    graph::Buffer<transport::BvhNode> nodes;
    graph::Buffer<transport::VertexData> corners;
    // Declares that a pass traces rays.
    void read(graph::PassSetup& setup) const;
    void bindTo(gl::Command& command, const FrameInputs& inputs) const;
};

[[nodiscard]] BvhOfFrame bvhOfFrame(FrameBuilder& frame, const Geometry& geometry);

// The exact first hit of every photon, as a pass "trace.bvh".
[[nodiscard]] Hits hitsByBvh(FrameBuilder& frame, const Photons& photons, const Geometry& geometry);

}  // namespace kaustik
