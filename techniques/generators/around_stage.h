// SPDX-License-Identifier: MIT
// The stage `around`: what lies around each caustic generator (U08, section 3). Run by whoever asks
// for it, once a frame.
#pragma once

#include <vector>

#include "framework/pipeline/frame_builder.h"
#include "techniques/raster_views/map_params.h"

namespace kaustik {

// Which layer of a texel is in which slot, four bits a slot from the lowest; 15: none.
struct LayerOrderTexel {
    static constexpr Format format = Format::r32ui;
};

// All surfaces around a caustic generator, as its reference point sees them (U08, section 3).
struct SurfacesAround {
    LayeredDepth layers;                    // of a cube
    graph::Texture<LayerOrderTexel> order;  // array, a layer a face
};

// The stage's answer has an entry for each generator (techniques/generators/generators.h).
struct AroundStage : Stage<std::vector<SurfacesAround>(Geometry)> {
    static constexpr const char* name = "around";
    static constexpr const char* question = "Which surfaces lie around each caustic generator?";
    static constexpr const char* takes = "geometry";
    static constexpr const char* gives =
        "layers on the faces of a cube around each caustic generator";
    // Nodes that ask for them say so (NodeDescription::reads).
    static std::string whyIdle(const FrameFacts& facts) {
        const auto& params = facts.settings.get<ReconstructParams>(ReconstructStage::name);
        return params.space == StoreSpace::cube ? "" : "nobody asks what lies around generators";
    }
};

// The surfaces around each generator, from the node that the settings choose; made once a frame.
[[nodiscard]] const std::vector<SurfacesAround>& surfacesAround(FrameBuilder& frame,
                                                                const Geometry& geometry);

}  // namespace kaustik
