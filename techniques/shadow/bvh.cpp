// SPDX-License-Identifier: MIT
// shadow.bvh: from every receiver pixel a ray back to each light, traced exactly, however photons
// are traced: on the device, or where that is the processor by Embree. In: eye buffer; out:
// visibility, 0 or 1 a pixel and light.
#include <fmt/format.h>

#include "framework/pipeline/frame_builder.h"
#include "techniques/tracing/bvh_rays.h"
#include "techniques/tracing/rays_by.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "techniques/shadow/processor_shadows.h"
#endif

namespace kaustik {
namespace {

struct BvhShadowParams {
    RaysBy rays = RaysBy::automatic;
    template <class R>
    void reflect(R& r) {
        reflectRaysBy(r, rays);
    }
};

Shadows traceExactShadowRays(FrameBuilder& frame, const BvhShadowParams& params, Geometry geometry,
                             EyeBuffer eye, LayeredDepth) {
    const int lights = frame.needs().lights;
    if (lights == 0) {
        frame.skip("shadow.bvh", "the scene has no light");
        return {};
    }
    if (isProcessorAsked(frame, params.rays, "shadow.bvh.rays")) {
#ifdef KAUSTIK_HAS_EMBREE
        return shadowsByProcessor(frame, "shadow.bvh", geometry, eye);
#endif
    }
    const BvhOfFrame bvh = bvhOfFrame(frame, geometry);
    return frame.pass<Shadows>(
        "shadow.bvh",
        fmt::format("a ray from every receiver back to the light, traced by the device through {} "
                    "triangles",
                    frame.gpuScene().bvh().triangleCount()),
        [&](graph::PassSetup& setup, Shadows& data) {
            setup.sample("receiver", eye.receiver);
            setup.sample("receiverSurface", eye.receiverSurface);
            bvh.read(setup);
            data.visibility = setup.image(
                "visibility", setup.create<VisibilityTexel>("shadow.visibility", frame.width(),
                                                            frame.height(), lights));
            setup.bypass(data.visibility, {1, 1, 1, 1});
        },
        [&inputs = frame.inputs(), bvh, lights](const Shadows&, gl::PassContext& context) {
            for (int light = 0; light < lights; ++light) {
                gl::Command command = context.compute("shadow/bvh.comp");
                bvh.bindTo(command, inputs);
                command.set("lightIndex", light)
                    .dispatchOver(inputs.view.width, 8, inputs.view.height, 8);
            }
        });
}

}  // namespace

void registerShadowBvh(Registry& registry) {
    registry.node<ShadowStage>(
        "bvh",
        {"Traces a ray from every receiver to the light exactly, through the hierarchy over all "
         "triangles, on the device or, where that is the processor, by Embree.",
         "", "A shadow is there or not, once a pixel. The hierarchy is that of trace.bvh."},
        &traceExactShadowRays);
}

}  // namespace kaustik
