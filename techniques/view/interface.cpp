// SPDX-License-Identifier: MIT
// view.interface: a first, simple look through specular surfaces. One refraction at the surface
// that the eye hits first, followed as far as the receiver lies straight beyond it; reflections
// see the background only, mirrors the scene. In: eye buffer and radiance of the receivers; out:
// radiance, W/m²/sr, and the refracted ray, view space, m.
#include "framework/pipeline/frame_builder.h"
#include "techniques/eye_rays/view_passes.h"
#include "techniques/raster_views/back_faces.h"

namespace kaustik {
namespace {

struct InterfaceViewParams {
    bool refract = true;
    SceneLookParams look;
    template <class R>
    void reflect(R& r) {
        r.field(refract, "refract", "Bend the eye's ray at the surface; off: look straight through")
            .when(&whyNoDielectric);
        look.reflect(r);
    }
};

View viewThroughInterface(FrameBuilder& frame, const InterfaceViewParams& params, Geometry geometry,
                          EyeBuffer eye, LayeredDepth layers, Radiance receivers, Shadows shadows,
                          CausticMap /*map*/) {
    if (!eye.interface.valid()) {
        return renderReceiversOnly(frame, "view.interface", receivers);
    }
    const View view =
        frame
            .pass<ViewPass>(
                "view.interface", lookReason(frame),
                [&](graph::PassSetup& setup, ViewPass& data) {
                    data = declareLook(frame, setup, params.look, geometry, eye, layers, receivers,
                                       shadows);
                },
                [&inputs = frame.inputs(), params](const ViewPass& data, gl::PassContext& context) {
                    drawLook(
                        inputs, context, data, params.look, "view/interface.frag",
                        [&](gl::Command& command) { command.params("view.interface", params); });
                })
            .seen;
    reportMirrorLimit(frame, "view.interface", view, params.look.mirrors);
    return view;
}

}  // namespace

void registerViewInterface(Registry& registry) {
    registry.node<ViewStage>("interface",
                             {"Looks through the first specular surface with one refraction, at "
                              "the distance of the receiver straight beyond it.",
                              "",
                              "It bends a ray once and takes the receiver at the distance that it "
                              "has straight beyond: what lies beside is seen at the wrong place. "
                              "Reflections at dielectrics see the background alone."},
                             &viewThroughInterface);
}

}  // namespace kaustik
