// SPDX-License-Identifier: MIT
// The farthest back faces of the transmitting objects in some view, for whoever asks where a ray
// leaves them (include/two_interfaces.glsl; W05).
#pragma once

#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct BackFaces {
    graph::Texture<ViewDepth> depth;
    graph::Texture<SurfaceTexel> surface;
    graph::Texture<HitShape> shape;  // in the view's space; where it was asked for
    Views views;                     // one
    // "backDepth", "backSurface", "backShape".
    void sample(graph::PassSetup& setup) const;
};

// What the pass is called, and the names of its textures begin with.
struct BackFacesPass {
    std::string name;
    std::string why;
    std::string prefix;
    bool hasShape = false;  // how their normals turn
};
[[nodiscard]] BackFaces drawBackFaces(FrameBuilder& frame, const Geometry& geometry,
                                      const Views& views, const BackFacesPass& pass);

}  // namespace kaustik
