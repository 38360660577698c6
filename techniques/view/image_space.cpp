// SPDX-License-Identifier: MIT
// view.image_space: image-space refraction at two interfaces (Wyman 2005, W05), with which K06
// compares its own (Table 1, in braces). "view.back_faces" draws the farthest back faces of the
// transmitting objects; "view.image_space" estimates from them where a refracted ray leaves, and
// looks up what it sees there as view.refraction does. In: eye buffer, radiance of the receivers;
// out: radiance, W/m²/sr, and where each ray left, view space, m.
//
// W05's weights and its precomputed distance along the inverse normal are in neither paper that
// describes it (techniques/papers.md): the weight here is the ratio of the angles of refraction and
// incidence, and the distance is searched among the back faces, `steps` looks and four bisections.
// What is totally reflected at the second interface is told apart and goes on unbent.
#include "framework/pipeline/frame_builder.h"
#include "techniques/eye_rays/view_passes.h"
#include "techniques/raster_views/back_faces.h"

namespace kaustik {
namespace {

struct ImageSpaceViewParams {
    int steps = 12;
    DistanceInside distance = DistanceInside::search;
    SceneLookParams look;
    template <class R>
    void reflect(R& r) {
        reflectDistance(r, distance, steps);
        look.reflect(r);
    }
};

View refractInImageSpace(FrameBuilder& frame, const ImageSpaceViewParams& params, Geometry geometry,
                         EyeBuffer eye, LayeredDepth layers, Radiance receivers, Shadows shadows,
                         CausticMap /*map*/) {
    if (!eye.interface.valid()) {
        return renderReceiversOnly(frame, "view.image_space", receivers);
    }
    BackFaces faces;
    if (frame.needs().refractors > 0) {
        faces = drawBackFaces(
            frame, geometry, frame.eyeViews(),
            {"view.back_faces", "the eye's rays leave transmitting objects through their backs",
             "view."});
    } else {
        frame.skip("view.back_faces", "the scene has no dielectric");
    }
    const View view =
        frame
            .pass<ViewPass>(
                "view.image_space", lookReason(frame),
                [&](graph::PassSetup& setup, ViewPass& look) {
                    if (faces.depth.valid()) faces.sample(setup);
                    look = declareLook(frame, setup, params.look, geometry, eye, layers, receivers,
                                       shadows);
                },
                [&inputs = frame.inputs(), params](const ViewPass& look, gl::PassContext& context) {
                    drawLook(
                        inputs, context, look, params.look, "view/image_space.frag",
                        [&](gl::Command& command) { command.params("view.image_space", params); });
                })
            .seen;
    reportMirrorLimit(frame, "view.image_space", view, params.look.mirrors);
    reportLostRays(frame, "view.image_space", view,
                   "they are totally reflected inside, which it does not follow");
    return view;
}

}  // namespace

void registerViewImageSpace(Registry& registry) {
    registry.node<ViewStage>(
        "image_space",
        {"Refracts the eye's rays at two interfaces, with the distance inside "
         "estimated from the back faces.",
         "Wyman 2005 (W05), K06's comparison",
         "It bends a ray at two interfaces, the front and the farthest back face; what is between "
         "them is not seen. What is totally reflected at the second goes on unbent, and beyond it "
         "only what the screen shows is found."},
        &refractInImageSpace);
}

}  // namespace kaustik
