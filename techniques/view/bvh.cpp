// SPDX-License-Identifier: MIT
// view.bvh: what the eye sees through specular surfaces, by exact rays through the hierarchy of the
// scene on the device (framework/transport/bvh.h). In: eye buffer, radiance of the receivers; out:
// radiance, W/m²/sr, and where each ray left for good, view space, m. Receivers that the picture
// does not show are lit by their own shadow rays; caustics are seen where the picture has them.
#include <cstddef>
#include <utility>

#include "framework/pipeline/frame_builder.h"
#include "techniques/eye_rays/view_passes.h"
#include "techniques/thread_lists/thread_list.h"
#include "techniques/tracing/bvh_rays.h"

namespace kaustik {
namespace {

struct BvhViewParams {
    int interfaces = 32;
    int reflections = 32;
    int mirrors = 16;
    int branches = 2;
    template <class R>
    void reflect(R& r) {
        r.field(interfaces, "interfaces", "Most refractions of an eye ray", "",
                params::range(0, 256));
        r.field(reflections, "reflections",
                "Most total internal reflections of an eye ray; what needs more is lost", "",
                params::range(0, 256));
        r.field(mirrors, "mirrors", "Most mirrors that a ray hits one after the other", "",
                params::range(1, 256))
            .when([](const FrameFacts& facts) {
                const bool mayHit = facts.needs == nullptr || facts.needs->reflectors > 0;
                return mayHit ? "" : "the scene has no mirror";
            });
        r.field(branches, "branches",
                "At how many of the first interfaces what is reflected is followed too; 0: the "
                "refracted ray alone",
                "", params::range(0, 4));
    }
};

void reportLimits(FrameBuilder& frame, const BvhViewParams& params, const View& seen) {
    reportDielectricLimits(frame, "view.bvh", seen, params.interfaces, params.reflections);
    reportMirrorLimit(frame, "view.bvh", seen, params.mirrors);
    reportLostRays(frame, "view.bvh", seen,
                   "no way out of the object that they are in was found; its surface has a hole "
                   "there");
}

struct BvhViewPass {
    ViewPass view;
    ThreadList pixels;
};

View traceView(FrameBuilder& frame, const BvhViewParams& params, Geometry geometry, EyeBuffer eye,
               LayeredDepth /*sceneLayers*/, Radiance receivers, Shadows shadows,
               CausticMap /*map*/) {
    if (!eye.interface.valid()) return renderReceiversOnly(frame, "view.bvh", receivers);
    const BvhOfFrame bvh = bvhOfFrame(frame, geometry);
    const View seen =
        frame
            .pass<BvhViewPass>(
                "view.bvh", lookReason(frame),
                [&](graph::PassSetup& setup, BvhViewPass& pass) {
                    pass.view = declareView(frame, setup, geometry, eye, receivers, shadows);
                    pass.pixels = ThreadList::create(setup, "LookedThrough", "view.bvh.pixels",
                                                     static_cast<std::size_t>(frame.width()) *
                                                         static_cast<std::size_t>(frame.height()));
                    bvh.read(setup);
                },
                [&inputs = frame.inputs(), params, bvh](const BvhViewPass& pass,
                                                        gl::PassContext& context) {
                    const auto look = [&](const Tell& tellSample, bool isMiddle) {
                        const auto shader = [&](const char* name) {
                            gl::Command command = context.compute(name);
                            tellSample(command);
                            command.image("viewRadiance", pass.view.seen.radiance);
                            if (isMiddle) {
                                command.image("viewExitPosition", pass.view.seen.exitPosition)
                                    .image("viewExitDirection", pass.view.seen.exitDirection);
                            }
                            return command;
                        };
                        pass.pixels.clear(context);
                        shader("view/bvh_list.comp")
                            .dispatchOver(inputs.view.width, 8, inputs.view.height, 8);
                        gl::Command command = shader("view/bvh.comp");
                        command.params("view.bvh", params).set("lightCount", inputs.needs.lights);
                        if (pass.view.isGlossy) command.define("GLOSSY_RECEIVERS");
                        bvh.bindTo(command, inputs);
                        pass.pixels.close(context);
                        pass.pixels.dispatchOver(std::move(command));
                    };
                    lookBySamples(inputs, context, pass.view, look);
                })
            .view.seen;
    reportLimits(frame, params, seen);
    return seen;
}

}  // namespace

void registerViewBvh(Registry& registry) {
    registry.node<ViewStage>(
        "bvh",
        {"Traces the eye's rays exactly, through a hierarchy over all triangles.", "",
         "Receivers that the picture does not show are lit directly, and have no caustic; under "
         "water they look like the one straight beyond the surface. What is "
         "reflected after view.bvh.branches interfaces is not followed. The hierarchy is that of "
         "trace.bvh."},
        &traceView);
}

}  // namespace kaustik
