// SPDX-License-Identifier: MIT
// view.deferred: deferred refraction of the eye's rays (WN09, section 3.1), through several bodies
// (3.1.1): "view.body_buffers" draws each body's fronts and backs once for both, and
// "view.deferred" looks through them in one pass over the screen. Not in passes from back to front,
// as published: the ray that leaves a body is searched in the fronts of the others, and refracted
// by its own direction, or, as the paper does, as if the eye saw that body straight. What it sees
// in the end is looked up as view.image_space does. In: eye buffer, radiance of the receivers; out:
// radiance, W/m²/sr, and where each ray left, view space, m. Of what bodies behind the first one
// reflect nothing is seen, and what is totally reflected inside goes on unbent.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "framework/pipeline/frame_builder.h"
#include "techniques/deferred_buffers/body_buffers.h"
#include "techniques/eye_rays/view_passes.h"
#include "techniques/raster_views/back_faces.h"

namespace kaustik {
namespace {

enum class EyesIncidence : int { ray, eye };

struct DeferredViewParams {
    int layers = 4;
    EyesIncidence incidence = EyesIncidence::ray;
    int steps = 12;
    DistanceInside distance = DistanceInside::search;
    BodySearchParams search;
    DeferredGeometry geometry = DeferredGeometry::once;
    SceneLookParams look;
    template <class R>
    void reflect(R& r) {
        r.field(layers, "layers",
                "Most bodies, those nearest to the eye, that rays go through one after the other",
                "bodies", params::range(1, 8))
            .when(&whyNoOtherBody);
        r.choice(incidence, "incidence",
                 "How rays come to a body behind another one. ray: as they have left that; eye: as "
                 "if the eye saw it straight (WN09, section 3.1.1)",
                 {"ray", "eye"})
            .when(&whyNoOtherBody);
        reflectDistance(r, distance, steps);
        search.reflect(r);
        reflectGeometry(r, geometry);
        look.reflect(r);
    }
};

BodyBuffers bodiesSeenByEye(FrameBuilder& frame, const DeferredViewParams& params,
                            const Geometry& geometry) {
    const std::vector<Body> bodies = nearestFirst(bodiesOf(frame), frame.scene().camera.position);
    if (bodies.empty()) {
        frame.skip("view.body_buffers", "no dielectric of the scene has an inside");
        return {};
    }
    const std::string names = omittedNames(bodies, params.layers);
    if (!names.empty()) {
        frame.warn(fmt::format(
            "view=deferred keeps {} of the {} bodies, those nearest to the eye: it looks straight "
            "through {} (view.deferred.layers).",
            params.layers, bodies.size(), names));
    }
    const int drawn = std::min(static_cast<int>(bodies.size()), params.layers);
    return drawBodies(
        frame, geometry, frame.eyeViews(), bodies,
        {drawn, "view.body_buffers",
         fmt::format("the eye's rays go through {} bod{}", drawn, drawn == 1 ? "y" : "ies"),
         "view.", false, params.geometry});
}

View refractDeferred(FrameBuilder& frame, const DeferredViewParams& params, Geometry geometry,
                     EyeBuffer eye, LayeredDepth layers, Radiance receivers, Shadows shadows,
                     CausticMap /*map*/) {
    if (!eye.interface.valid()) return renderReceiversOnly(frame, "view.deferred", receivers);
    const BodyBuffers bodies = bodiesSeenByEye(frame, params, geometry);
    const View view = frame
                          .pass<ViewPass>(
                              "view.deferred", lookReason(frame),
                              [&](graph::PassSetup& setup, ViewPass& look) {
                                  if (bodies.bodies > 0) bodies.sample(setup);
                                  look = declareLook(frame, setup, params.look, geometry, eye,
                                                     layers, receivers, shadows);
                              },
                              [&inputs = frame.inputs(), params, bodies](const ViewPass& look,
                                                                         gl::PassContext& context) {
                                  drawLook(inputs, context, look, params.look, "view/deferred.frag",
                                           [&](gl::Command& command) {
                                               if (bodies.bodies > 0) bodies.bindTo(command);
                                               command.params("view.deferred", params);
                                           });
                              })
                          .seen;
    reportMirrorLimit(frame, "view.deferred", view, params.look.mirrors);
    reportLostRays(frame, "view.deferred", view,
                   "they are totally reflected inside, which it does not follow");
    return view;
}

}  // namespace

void registerViewDeferred(Registry& registry) {
    registry.node<ViewStage>(
        "deferred",
        {"Refracts the eye's rays through several bodies in turn, of each by fronts and backs that "
         "are drawn once.",
         "WN09, sections 3.1 and 3.1.1; W05",
         "It knows of each body its front and its back, of no more than view.deferred.layers "
         "bodies. What is totally reflected inside goes on unbent, and bodies behind the first one "
         "reflect nothing."},
        &refractDeferred);
}

}  // namespace kaustik
