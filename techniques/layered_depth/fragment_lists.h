// SPDX-License-Identifier: MIT
// Layered depth from lists of fragments (Yang et al. 2010), for whoever needs layers of some of the
// scene's surfaces.
#pragma once

#include "techniques/screen_space_photons/peel.h"

namespace kaustik {

struct ListsParams {
    int memoryMebibytes = 256;
    int room = 8;
    template <class R>
    void reflect(R& r) {
        r.field(memoryMebibytes, "memory",
                "Most memory for fragments, 36 bytes each; a view that has more is peeled. No more "
                "than the storage blocks hold that every device has",
                "MiB", params::range(1, 288));
        r.field(room, "room",
                "Fragments that there is room for, a pixel of the view on average, within that "
                "memory; a view that has more is peeled",
                "", params::range(1, 1024));
    }
};

// Adds the pass of a layered depth image without a pyramid: bit for bit what peel() makes, from one
// drawing of the surfaces.
[[nodiscard]] LayeredDepth listFragments(FrameBuilder& frame, Geometry geometry,
                                         const LayersRequest& request, const ListsParams& params);

// For some of the scene's surfaces: by lists where `layers` is set to them, or to auto and they are
// faster, and more than a few layers are asked for; else peeled.
[[nodiscard]] LayeredDepth makeLayers(FrameBuilder& frame, Geometry geometry,
                                      const LayersRequest& request);

}  // namespace kaustik
