// SPDX-License-Identifier: MIT
// Which surface each light sees first, everywhere in the scene: for whoever asks whether direct
// light reaches a point, seen by the eye or not. Specular objects block it fully; what passes
// through them arrives as caustic light.
#pragma once

#include "techniques/raster_views/light_sight.h"

namespace kaustik {

struct ShadowMapParams {
    int size = 2048;
    template <class R>
    void reflect(R& r) {
        r.field(size, "size",
                "Side of a light's shadow map; half of it where a light has a place, and with it "
                "six faces, and less where points stand for a light that has a size",
                "texels", params::range(16, 8192));
    }
};

struct ShadowMaps {
    LightDepths depths;                 // a layer a view: one of a sun, six of a light with a place
    const gl::Buffer* views = nullptr;  // of ShadowView, by layer
};

// By shadow.map.size, whichever node answers stage `shadow`. Made once a frame, by the first who
// asks; the scene must have a light.
[[nodiscard]] const ShadowMaps& shadowMaps(FrameBuilder& frame, const Geometry& geometry);

// For a pass that looks them up, and for a command of it: shaders include
// include/views/light_shadow.glsl.
void readShadowMaps(graph::PassSetup& setup, const ShadowMaps& maps);
gl::Command& bindShadowMaps(gl::Command& command, const ShadowMaps& maps);

}  // namespace kaustik
