// SPDX-License-Identifier: MIT
// Layered depth from lists of fragments (Yang et al. 2010), for whoever needs layers of some of the
// scene's surfaces.
#pragma once

#include "techniques/layered_depth/depth_peeling.h"

namespace kaustik {

struct ListsParams {
    int memoryMebibytes = 256;
    int fragmentsPerPixel = 8;
    template <class R>
    void reflect(R& r) {
        r.field(memoryMebibytes, "memory",
                "Most memory for fragments, 36 bytes each; a view that has more is peeled. No more "
                "than the storage blocks hold that every device has",
                "MiB", params::range(1, 288));
        r.field(fragmentsPerPixel, "fragments_per_pixel",
                "Fragments that there is room for, a pixel of the view on average, within that "
                "memory; a view that has more is peeled",
                "", params::range(1, 1024));
        r.renamed("room", "fragments_per_pixel");
    }
};

// Adds the pass of a layered depth image without a pyramid: bit for bit what peel() makes, from one
// drawing of the surfaces.
[[nodiscard]] LayeredDepth listFragments(FrameBuilder& frame, Geometry geometry,
                                         const LayersRequest& request, const ListsParams& params);

// How many triangles the surfaces have that are drawn.
[[nodiscard]] std::size_t triangleCount(const scene::Scene& scene, render::DrawSet set);

// Peeling draws every triangle again for each layer, lists sort every pixel: on the devices
// measured (results/layers.md, "Layers in one pass") they are even where there are as many of the
// one as of the other.
[[nodiscard]] bool prefersLists(FrameBuilder& frame, const LayersRequest& request);

// Makes the layers of some of the scene's surfaces: by lists where `layers` is set to them, or to
// auto and they are faster, and more than a few layers are asked for; else by peeling.
[[nodiscard]] LayeredDepth makeLayers(FrameBuilder& frame, Geometry geometry,
                                      const LayersRequest& request);

}  // namespace kaustik
