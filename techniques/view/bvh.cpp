// SPDX-License-Identifier: MIT
// view.bvh: what the eye sees through specular surfaces, by exact rays: through the hierarchy of
// the scene on the device (framework/transport/bvh.h), or the processor's (traced_paths.h). In: eye
// buffer, radiance of the receivers; out: radiance, W/m²/sr, how each ray ended, and, where
// somebody asks for it, where it left for good, view space, m. Receivers that the picture does not
// show are lit by their own shadow rays; caustics are seen where the picture has them.
#include <fmt/format.h>

#include <cstddef>
#include <utility>

#include "framework/pipeline/frame_builder.h"
#include "techniques/eye_rays/view_passes.h"
#include "techniques/thread_lists/thread_list.h"
#include "techniques/tracing/bvh_rays.h"
#include "techniques/view/traced_paths.h"

namespace kaustik {
namespace {

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
    TracedPaths paths;
};

View traceView(FrameBuilder& frame, const BvhViewParams& params, Geometry geometry, EyeBuffer eye,
               LayeredDepth /*sceneLayers*/, Radiance receivers, Shadows shadows,
               CausticMap /*map*/) {
    if (!eye.interface.valid()) return renderReceiversOnly(frame, "view.bvh", receivers);
    const PathsFinder finder(frame, params, geometry);
    const BvhOfFrame bvh = finder.isTraced() ? BvhOfFrame{} : bvhOfFrame(frame, geometry);
    const View seen =
        frame
            .pass<BvhViewPass>(
                "view.bvh",
                fmt::format("{}, traced by the {}", lookReason(frame),
                            finder.isTraced() ? "processor" : "device"),
                [&](graph::PassSetup& setup, BvhViewPass& pass) {
                    pass.view = declareView(frame, setup, geometry, eye, receivers, shadows);
                    pass.pixels = ThreadList::create(setup, "LookedThrough", "view.bvh.pixels",
                                                     static_cast<std::size_t>(frame.width()) *
                                                         static_cast<std::size_t>(frame.height()));
                    pass.paths = finder.create(setup, eye);
                    bvh.read(setup);
                },
                [&inputs = frame.inputs(), params, bvh, finder](const BvhViewPass& pass,
                                                                gl::PassContext& context) {
                    const auto look = [&](const PixelSample& sample) {
                        const auto shader = [&](const char* name) {
                            gl::Command command = context.compute(name);
                            sample.tell(command);
                            command.image("viewRadiance", pass.view.seen.radiance);
                            if (!sample.isMiddle()) return command;
                            command.image("viewPathEnding", pass.view.seen.ending);
                            if (!storesExits(context, pass.view.seen)) return command;
                            command.define("EXITS")
                                .image("viewExitPosition", pass.view.seen.exitPosition)
                                .image("viewExitDirection", pass.view.seen.exitDirection);
                            return command;
                        };
                        const auto shaderOfPaths = [&](const char* name) {
                            gl::Command command = shader(name);
                            command.set("lightCount", inputs.needs.lights);
                            if (pass.view.isGlossy) command.define("GLOSSY_RECEIVERS");
                            return command;
                        };
                        pass.pixels.clear(context);
                        shader("view/bvh_list.comp")
                            .dispatchOver(inputs.view.width, 8, inputs.view.height, 8);
                        if (finder.isTraced()) {
                            finder.find(inputs, context, pass.paths, pass.pixels, sample.offset,
                                        [&] { return shaderOfPaths("view/processor_paths.comp"); });
                            return;
                        }
                        gl::Command command = shaderOfPaths("view/bvh.comp");
                        command.params("view.bvh", params);
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
        {"Traces the eye's rays exactly, through a hierarchy over all triangles, on the device or, "
         "where that is the processor, by Embree.",
         "",
         "Receivers that the picture does not show are lit directly, and have no caustic; under "
         "water they look like the one straight beyond the surface. What is "
         "reflected after view.bvh.branches interfaces is not followed. The hierarchy is that of "
         "trace.bvh."},
        &traceView);
}

}  // namespace kaustik
