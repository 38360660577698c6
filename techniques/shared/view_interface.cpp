// SPDX-License-Identifier: MIT
// view.interface: a first, simple look through specular surfaces. One refraction at the surface
// that the eye meets first, followed as far as the receiver lies straight behind it; reflections
// see the background only. In: eye buffer and radiance of the receivers; out: radiance, W/m²/sr.
#include "framework/pipeline/frame_builder.h"
#include "techniques/shared/nodes.h"

namespace kaustik {

View viewThroughInterface(FrameBuilder& frame, const InterfaceViewParams& params,
                          Geometry /*geometry*/, EyeBuffer eye, LayeredDepth /*layers*/,
                          Radiance receivers) {
    if (!eye.interface.valid()) {
        frame.leaveOut("view.interface", "the scene has no specular surface");
        return {receivers.radiance, {}, {}};
    }
    struct Data {
        EyeBuffer eye;
        Radiance receivers;
        View seen;
    };
    return frame
        .pass<Data>(
            "view.interface", "the eye looks through specular surfaces",
            [&](graph::PassSetup& setup, Data& data) {
                data.eye = eye;
                data.receivers = receivers;
                setup.read(eye.interface);
                setup.read(eye.interfaceSurface);
                setup.read(eye.receiver);
                setup.read(receivers.radiance);
                data.seen.radiance =
                    setup.create<RadianceTexel>("view.radiance", frame.width(), frame.height());
                setup.bypass(data.seen.radiance, receivers.radiance);
            },
            [&inputs = frame.inputs(), params](const Data& data, gl::PassContext& context) {
                gl::Command command = context.fullscreen("shared/view_interface.frag");
                inputs.bindView(command)
                    .params("view.interface", params)
                    .storage("Materials", inputs.gpuScene.materials())
                    .texture("interfaceDepth", data.eye.interface)
                    .texture("interfaceSurface", data.eye.interfaceSurface)
                    .texture("receiver", data.eye.receiver)
                    .texture("receiverRadiance", data.receivers.radiance)
                    .texture("sceneImages", inputs.gpuScene.images())
                    .target(data.seen.radiance)
                    .draw();
            })
        .seen;
}

}  // namespace kaustik
