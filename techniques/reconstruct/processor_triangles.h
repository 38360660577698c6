// SPDX-License-Identifier: MIT
// reconstruct.triangles where the processor covers the eye's pixels: what it knows of them and what
// they have, from a frame's first light to its last; there in builds with Embree alone.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "framework/pipeline/frame_builder.h"
#include "techniques/reconstruct/edge_samples.h"
#include "techniques/reconstruct/processor_patches.h"
#include "techniques/stores/stores.h"

namespace kaustik {

struct ProcessorPixels {
    SeenPixels seen;
    std::vector<std::uint64_t> sums;  // three channels a pixel, row by row
    std::vector<PixelBlock> blocks;
};

// The first thing in a frame, once squares of pixels are made: nothing has light.
void clearPixels(ProcessorPixels& pixels, const render::RasterView& eye, const Store& store,
                 const EdgeSamples& edges, const graph::Buffer<PixelBlock>& blocks,
                 const gl::PassContext& context);
// Patches that shaders have listed, kind by kind.
struct ListedPatches {
    const graph::Buffer<std::uint32_t>& lists;  // begins with a ThreadListHeader a kind
    std::size_t kinds;
    const graph::Buffer<transport::PatchData>& made;  // where they are to stand
    std::size_t room;                                 // for so many at once
    std::size_t most;                                 // that the list of a kind has room for
    // Has the shaders write those of a kind, the first one to this place, which may lie before the
    // first that there is room for.
    std::function<void(std::size_t kind, int firstPlace)> make;
};
void coverOnProcessor(ProcessorPixels& pixels, const ListedPatches& listed, TriangleShading shading,
                      const FrameInputs& inputs, const Ledger& ledger,
                      const gl::PassContext& context);

}  // namespace kaustik
