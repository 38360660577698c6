// SPDX-License-Identifier: MIT
// view.refraction: screen-space refraction tracing (K06, section 4). The passes "view.layers.…"
// peel the transmitting objects alone; "view.refraction" follows the eye's transmitted ray of every
// pixel through them and looks up what it sees: the receivers that the eye buffer shows (the
// refracted scene, Fig. 10), else what surrounds the scene. The reflection at the first interface
// is looked up the same way; later partial reflections are left out. In: eye buffer, radiance of
// the receivers; out: radiance, W/m²/sr, and where each ray left for good, view space, m.
//
// The paper does not say what happens at total internal reflection (here the ray goes on, between
// the same two layers), nor when a ray leaves through the layer that it has entered by (here it is
// then between that layer and the one before).
#include <algorithm>

#include "framework/pipeline/frame_builder.h"
#include "techniques/screen_space_photons/nodes.h"
#include "techniques/screen_space_photons/view_passes.h"

namespace kaustik {

namespace {

// A path crosses a sheet of water once: where there is nothing else, no second interface is looked
// for, nor peeled.
RefractionViewParams forScene(const scene::SceneNeeds& needs, RefractionViewParams params) {
    if (!needs.closedDielectrics)
        params.interfaces = std::min(params.interfaces, std::max(needs.refractors, 1));
    return params;
}

}  // namespace

View traceRefraction(FrameBuilder& frame, const RefractionViewParams& wanted, Geometry geometry,
                     EyeBuffer eye, LayeredDepth /*layers*/, Radiance receivers) {
    if (!eye.interface.valid()) {
        frame.leaveOut("view.refraction", "the scene has no specular surface");
        return {receivers.radiance, {}, {}};
    }
    const RefractionViewParams params = forScene(frame.needs(), wanted);
    const auto trace = frame.params<TraceParams>("trace");
    const bool isMonotonic = params.search == RefractionSearch::monotonic;
    LayeredDepth layers;
    {
        const FrameBuilder::Within within(frame, "view");
        // The n-th interface is looked for in the n-th layer, and no deeper.
        layers = peel(frame, geometry,
                      {"view.layers", render::DrawSet::dielectrics,
                       isMonotonic ? std::min(params.layers, params.interfaces) : params.layers});
    }
    struct Data {
        EyeBuffer eye;
        LayeredDepth layers;
        Radiance receivers;
        View seen;
    };
    const DielectricsBox box = boxOfDielectrics(frame);
    const bool hasInside = frame.needs().closedDielectrics;
    return frame
        .pass<Data>(
            "view.refraction", "the eye looks through specular surfaces",
            [&](graph::PassSetup& setup, Data& data) {
                data.eye = eye;
                data.layers = layers;
                data.receivers = receivers;
                setup.read(layers.depth);
                setup.read(layers.surface);
                setup.read(layers.normal);
                data.seen = createView(frame, setup, eye, receivers);
            },
            [&inputs = frame.inputs(), params, trace, box, hasInside](const Data& data,
                                                                      gl::PassContext& context) {
                gl::Command command = context.fullscreen("screen_space_photons/refraction.frag");
                if (hasInside) command.define("CLOSED_DIELECTRICS");
                if (box.holdsReceivers) command.define("RECEIVERS_INSIDE");
                bindView(inputs, command, data.eye, data.receivers, params.look, data.seen);
                command.params("view.refraction", params)
                    .params("trace", trace)
                    .texture("layerDepths", data.layers.depth)
                    .texture("layerSurfaces", data.layers.surface)
                    .texture("layerNormals", data.layers.normal)
                    .set("layerCount", data.layers.layers)
                    .set("dielectricsCenterVs", box.centerVs)
                    .set("dielectricsHalfExtent", box.halfExtentMeters)
                    .draw();
            })
        .seen;
}

}  // namespace kaustik
