// SPDX-License-Identifier: MIT
// eye.surfaces: the eye buffer (design, section 1). `eye.receivers` draws all but dielectrics,
// which are invisible to the straight ray; `eye.interface` the first specular surface of each
// pixel, with that depth buffer: dielectrics in front of what it holds, and the mirrors that it
// holds (B16: geometry drawn twice has the same depth). View space, m; receiver areas in m².
#include "framework/pipeline/frame_builder.h"
#include "techniques/shared/nodes.h"

namespace kaustik {
namespace {

EyeBuffer renderEye(FrameBuilder& frame, const params::NoParams&, Geometry geometry) {
    struct Data {
        EyeBuffer eye;
        graph::Texture<DepthBuffer> depth;
        Geometry geometry;
    };
    const glm::mat4 projection = frame.view().projection();
    Data receivers = frame.pass<Data>(
        "eye.receivers", "caustics are measured at the receivers that the eye sees",
        [&](graph::PassSetup& setup, Data& data) {
            data.geometry = geometry;
            if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
            const int w = frame.width();
            const int h = frame.height();
            data.eye.receiver = setup.create<ReceiverTexel>("eye.receiver", w, h);
            data.eye.receiverSurface = setup.create<SurfaceTexel>("eye.receiver_surface", w, h);
            data.eye.receiverAlbedo = setup.create<AlbedoTexel>("eye.receiver_albedo", w, h);
            data.depth = setup.create<DepthBuffer>("eye.depth_buffer", w, h);
        },
        [&inputs = frame.inputs(), projection](const Data& data, gl::PassContext& context) {
            gl::Command command = context.shaders({"shared/eye.vert", "shared/eye_receiver.frag"});
            command.set("projection", projection);
            command.target(data.eye.receiver).clear();
            command.target(data.eye.receiverSurface).clear();
            command.target(data.eye.receiverAlbedo).clear();
            command.depth(data.depth, gl::DepthTest::nearerReversed).clear();
            inputs.gpuScene.draw(command, context, data.geometry, inputs.instances,
                                 render::DrawSet::nonDielectrics);
        });
    if (frame.needs().specularInterfaces == 0) {
        frame.skip("eye.interface", "the scene has no specular surface");
        return receivers.eye;
    }
    return frame
        .pass<Data>(
            "eye.interface", "the scene has specular surfaces that the eye looks through",
            [&](graph::PassSetup& setup, Data& data) {
                data = receivers;
                if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
                data.depth = setup.write(receivers.depth);
                const int w = frame.width();
                const int h = frame.height();
                data.eye.interface = setup.create<ViewDepth>("eye.interface", w, h);
                data.eye.interfaceSurface =
                    setup.create<SurfaceTexel>("eye.interface_surface", w, h);
                setup.bypass(data.depth, receivers.depth);
                setup.bypass(data.eye.interface, {0, 0, 0, 0});
                setup.bypass(data.eye.interfaceSurface, {0, 0, 0, 0});
            },
            [&inputs = frame.inputs(), projection](const Data& data, gl::PassContext& context) {
                gl::Command command =
                    context.shaders({"shared/eye.vert", "shared/eye_interface.frag"});
                command.set("projection", projection);
                command.target(data.eye.interface).clear();
                command.target(data.eye.interfaceSurface).clear();
                command.depth(data.depth, gl::DepthTest::nearerReversed);
                inputs.gpuScene.draw(command, context, data.geometry, inputs.instances,
                                     render::DrawSet::dielectrics);
                if (inputs.needs.reflectors == 0) return;
                gl::Command mirrors =
                    context.shaders({"shared/eye.vert", "shared/eye_interface.frag"});
                mirrors.set("projection", projection)
                    .target(data.eye.interface)
                    .target(data.eye.interfaceSurface)
                    .depth(data.depth, gl::DepthTest::atReversed);
                inputs.gpuScene.draw(mirrors, context, data.geometry, inputs.instances,
                                     render::DrawSet::mirrors);
            })
        .eye;
}

}  // namespace

void registerEyeSurfaces(Registry& registry) {
    registry.node<EyeStage>("surfaces",
                            {"Rasterises the first receiver and the first specular surface of "
                             "every pixel.",
                             ""},
                            &renderEye);
}

}  // namespace kaustik
