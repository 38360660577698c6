// SPDX-License-Identifier: MIT
// What of the scene's specular surfaces lies in the way of photons that are on their way to a
// receiver, for tracers that find receivers alone (TraceStage::Traits::onlyReceivers): by layers of
// what is specular in each light's view. Light is stopped there, and goes on only if the specular
// node knows how.
#pragma once

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

// A triangle that a ray has met. xyz: its unit normal, outward, eye view space; w: how far it is,
// m.
struct MetTriangle {
    static constexpr Format format = Format::rgba32f;
};

// By photon; as shaders/tracing/specular_ahead.glsl asks for it.
struct SpecularAhead {
    graph::Texture<SurfaceTexel> surface;  // w 0: nothing is in its way
    graph::Texture<MetTriangle> triangle;
    graph::Texture<HitShape> shape;  // where photons have beams
    [[nodiscard]] bool valid() const { return surface.valid(); }
    // Declares that a pass reads it, whose shaders are compiled as SPECULAR_AHEAD; where it is
    // invalid, nothing.
    void sample(graph::PassSetup& setup) const;
};

// Adds the passes that find it; invalid where none of these photons can meet anything specular, or
// trace.blockers is 0.
[[nodiscard]] SpecularAhead findSpecularAhead(FrameBuilder& frame, const Photons& photons,
                                              const Geometry& geometry);

}  // namespace kaustik
