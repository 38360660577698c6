// SPDX-License-Identifier: MIT
// eye.surfaces: the eye buffer (framework/README.md, "Outputs"). `eye.receivers` draws all but
// dielectrics, which are invisible to the straight ray; `eye.interface` the first specular surface
// of each pixel, with that depth buffer: dielectrics in front of what it holds, and the mirrors
// that it holds (B16: geometry drawn twice has the same depth). View space, m; receiver areas in
// m².
#include "framework/pipeline/frame_builder.h"
#include "techniques/raster_views/receivers.h"

namespace kaustik {

SeenReceivers renderReceivers(FrameBuilder& frame, Geometry geometry, const Views& views,
                              const std::string& name, const std::string& reason,
                              render::DrawSet drawn) {
    return frame.pass<SeenReceivers>(
        name + ".receivers", reason,
        [&](graph::PassSetup& setup, SeenReceivers& data) {
            data.geometry = geometry;
            if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
            const int w = views->width();
            const int h = views->height();
            const int layers = views->layers();
            ReceiverView& seen = data.receivers;
            seen.views = views;
            seen.receiver = setup.create<ReceiverTexel>(name + ".receiver", w, h, layers);
            seen.receiverSurface =
                setup.create<SurfaceTexel>(name + ".receiver_surface", w, h, layers);
            seen.receiverAlbedo =
                setup.create<AlbedoTexel>(name + ".receiver_albedo", w, h, layers);
            data.depth = setup.create<DepthBuffer>(name + ".depth_buffer", w, h);
        },
        [&inputs = frame.inputs(), drawn](const SeenReceivers& data, gl::PassContext& context) {
            const ReceiverView& seen = data.receivers;
            for (int face = 0; face < seen.views->count(); ++face) {
                gl::Command command =
                    context.shaders({"raster_views/eye.vert", "eye/surfaces_receiver.frag"});
                seen.views->bindTo(command).set("projection", seen.views->view(face).projection());
                if (seen.views->count() > 1) command.set("face", face);
                command.target(seen.receiver, face).clear();
                command.target(seen.receiverSurface, face).clear();
                command.target(seen.receiverAlbedo, face).clear();
                command.depth(data.depth, gl::DepthTest::nearerReversed).clear();
                inputs.gpuScene.draw(command, context, data.geometry, seen.views->instances(face),
                                     drawn);
            }
        });
}

namespace {

EyeBuffer renderEye(FrameBuilder& frame, const params::NoParams&, Geometry geometry) {
    struct Data {
        EyeBuffer eye;
        graph::Texture<DepthBuffer> depth;
        Geometry geometry;
    };
    const glm::mat4 projection = frame.view().projection();
    const SeenReceivers seen =
        renderReceivers(frame, geometry, frame.eyeViews(), "eye",
                        "caustics are measured at the receivers that the eye sees");
    EyeBuffer receivers;
    static_cast<ReceiverView&>(receivers) = seen.receivers;
    if (frame.needs().specularInterfaces == 0) {
        frame.skip("eye.interface", "the scene has no specular surface");
        return receivers;
    }
    return frame
        .pass<Data>(
            "eye.interface", "the scene has specular surfaces that the eye looks through",
            [&](graph::PassSetup& setup, Data& data) {
                data.eye = receivers;
                data.geometry = geometry;
                if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
                data.depth = setup.write(seen.depth);
                const int w = frame.width();
                const int h = frame.height();
                data.eye.interface = setup.create<ViewDepth>("eye.interface", w, h);
                data.eye.interfaceSurface =
                    setup.create<SurfaceTexel>("eye.interface_surface", w, h);
                setup.bypass(data.depth, seen.depth);
                setup.bypass(data.eye.interface, {0, 0, 0, 0});
                setup.bypass(data.eye.interfaceSurface, {0, 0, 0, 0});
            },
            [&inputs = frame.inputs(), projection](const Data& data, gl::PassContext& context) {
                gl::Command command =
                    context.shaders({"raster_views/eye.vert", "eye/surfaces_interface.frag"});
                command.set("projection", projection);
                command.target(data.eye.interface).clear();
                command.target(data.eye.interfaceSurface).clear();
                command.depth(data.depth, gl::DepthTest::nearerReversed);
                inputs.gpuScene.draw(command, context, data.geometry, inputs.instances,
                                     render::DrawSet::dielectrics);
                if (inputs.needs.reflectors == 0) return;
                gl::Command mirrors =
                    context.shaders({"raster_views/eye.vert", "eye/surfaces_interface.frag"});
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
    registry.node<EyeStage>(
        "surfaces",
        {"Rasterises the first receiver and the first specular surface of "
         "every pixel.",
         "",
         "A pixel knows one receiver and one specular surface, those on the ray through its "
         "middle: what is thinner than a pixel may be missed. What lies behind the first specular "
         "surface is for the stages layers and view to find."},
        &renderEye);
}

}  // namespace kaustik
