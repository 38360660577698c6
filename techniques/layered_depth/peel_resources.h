// SPDX-License-Identifier: MIT
// What the ways to peel layers keep while they do, and the drawing that they share.
#pragma once

#include "framework/gl/objects.h"
#include "framework/pipeline/frame_builder.h"
#include "techniques/layered_depth/depth_peeling.h"

namespace kaustik {

struct CountTexel {  // fragments in the pixel
    static constexpr graph::Format format = graph::Format::r32f;
};
// An indirect draw (peel_commands.comp).
struct DrawCommandWords {
    GLuint words[5];
};

// What a pass that peels makes.
struct Peeling {
    LayeredDepth layers;  // without statistics
    graph::Texture<DepthBuffer> depth;
    graph::Buffer<DrawCommandWords> commands;  // of all objects, once a layer, and a blank triangle
    Geometry geometry;
    // Fragments of each pixel, of one view: where it is valid a shader has stored where each
    // pixel's layers end (LayeredDepth), and no layer is cleared.
    graph::Texture<CountTexel> counts;
    // Targets are cleared by the blank triangle, where that is drawn at all: whether there is
    // anything to peel is known to the device alone.
    bool isConditional = false;

    // Declares it, and what is drawn.
    static Peeling create(FrameBuilder& frame, graph::PassSetup& setup, Geometry geometry,
                          const LayersRequest& request);
};
// Draws the layers of one view, each beyond the one before it, those that `commands` do not leave
// out; the others are cleared, where no counts say how far a pixel's layers go.
void peelView(const FrameInputs& inputs, const Peeling& peeling, gl::PassContext& context,
              const LayersRequest& request, int face);

}  // namespace kaustik
