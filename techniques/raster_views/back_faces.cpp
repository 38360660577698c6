// SPDX-License-Identifier: MIT
#include "techniques/raster_views/back_faces.h"

namespace kaustik {

void BackFaces::sample(graph::PassSetup& setup) const {
    setup.sample("backDepth", depth);
    setup.sample("backSurface", surface);
    if (shape.valid()) setup.sample("backShape", shape);
}

BackFaces drawBackFaces(FrameBuilder& frame, const Geometry& geometry, const Views& views,
                        const BackFacesPass& pass) {
    struct Data {
        BackFaces faces;
        graph::Texture<DepthBuffer> depthBuffer;
        Geometry geometry;
    };
    return frame
        .pass<Data>(
            pass.name, pass.reason,
            [&](graph::PassSetup& setup, Data& data) {
                data.geometry = geometry;
                if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
                const int w = views->width();
                const int h = views->height();
                data.faces.views = views;
                data.faces.depth = setup.create<ViewDepth>(pass.prefix + "back_depth", w, h);
                data.faces.surface = setup.create<SurfaceTexel>(pass.prefix + "back_surface", w, h);
                if (pass.hasShape)
                    data.faces.shape = setup.create<HitShape>(pass.prefix + "back_shape", w, h);
                data.depthBuffer =
                    setup.create<DepthBuffer>(pass.prefix + "back_depth_buffer", w, h);
            },
            [&inputs = frame.inputs()](const Data& data, gl::PassContext& context) {
                const render::RasterViews& drawn = *data.faces.views;
                gl::Command command =
                    context.shaders({"raster_views/eye.vert", "raster_views/back_faces.frag"});
                drawn.bindTo(command).set("projection", drawn.view(0).projection());
                command.target(data.faces.depth).clear();
                command.target(data.faces.surface).clear();
                if (data.faces.shape.valid())
                    command.define("SHAPES").target(data.faces.shape).clear();
                // Reversed z: the smaller value is the farther one.
                command.depth(data.depthBuffer, gl::DepthTest::nearer).clear({1, 0, 0, 0});
                inputs.gpuScene.draw(command, context, data.geometry, drawn.instances(0),
                                     render::DrawSet::dielectrics);
            })
        .faces;
}

}  // namespace kaustik
