// SPDX-License-Identifier: MIT
// Nodes that every technique may use.
#pragma once

#include "framework/pipeline/registry.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/shared/view_passes.h"

namespace kaustik {

void registerSharedNodes(Registry& registry);

// The node that leaves in-scattered light out; after those that make it, of which the first is the
// stage's default.
void registerMediaLeftOut(Registry& registry);

Geometry makeHeightFields(FrameBuilder& frame, const params::NoParams&);

EyeBuffer renderEye(FrameBuilder& frame, const params::NoParams&, Geometry geometry);

Hits emitGrid(FrameBuilder& frame, const params::NoParams&, Surfaces surfaces, Samples samples);

Photons interactAtInterface(FrameBuilder& frame, const params::NoParams&, Hits hits);
Photons interactAsNeeded(FrameBuilder& frame, const params::NoParams&, Hits hits);

struct SplitParams {
    int levels = 1;
    template <class R>
    void reflect(R& r) {
        r.field(levels, "levels",
                "Interactions at which both branches are followed, which doubles the transfer map; "
                "at later ones each photon takes one of them, drawn by its share",
                "", params::range(0, 6));
    }
};
Photons splitAtInterface(FrameBuilder& frame, const SplitParams& params, Hits hits);

IrradianceMap gatherOnScreen(FrameBuilder& frame, const params::NoParams&, CausticMap map,
                             Surfaces surfaces);

struct InterfaceViewParams {
    bool refract = true;
    SceneLookParams look;
    template <class R>
    void reflect(R& r) {
        r.field(refract, "refract",
                "Bend the eye's ray at the surface; off: look straight through");
        look.reflect(r);
    }
};
View viewThroughInterface(FrameBuilder& frame, const InterfaceViewParams& params, Geometry geometry,
                          EyeBuffer eye, LayeredDepth layers, Radiance receivers, Shadows shadows);

struct ShadowMapParams {
    int size = 1024;
    template <class R>
    void reflect(R& r) {
        r.field(size, "size", "Side of a light's shadow map", "texels", params::range(16, 8192));
    }
};
Shadows lookUpShadowMaps(FrameBuilder& frame, const ShadowMapParams& params, Geometry geometry,
                         EyeBuffer eye, LayeredDepth layers);

InScattered leaveOutScattering(FrameBuilder& frame, const params::NoParams&, Hits hits,
                               EyeBuffer eye, InScattered before);
InScattered leaveUnblurred(FrameBuilder& frame, const params::NoParams&, InScattered sharp);

struct PictureParams {
    float exposure = 0.0f;
    template <class R>
    void reflect(R& r) {
        r.field(
            exposure, "exposure",
            "Brightness of the display image; 0: from the irradiance at the middle of the scene",
            "1/(W/m²/sr)", params::range(0.0f, 1e6f));
    }
};
Picture composePicture(FrameBuilder& frame, const PictureParams& params, Geometry geometry,
                       EyeBuffer eye, LayeredDepth layers, LightParts light);

}  // namespace kaustik
