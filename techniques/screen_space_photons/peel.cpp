// SPDX-License-Identifier: MIT
// layers.peel: a layered depth image by depth peeling (K06, section 2.2). `layers.complexity`
// counts the fragments of every pixel; `layers.peel` then draws as many layers as the fullest pixel
// needs, `layers.count` at most; what lies deeper is counted. Out: arrays of view depth with its
// extent over the pixel (m) and the triangles' normals, and of outward shading normals with
// materials, front to back.
#include <fmt/format.h>

#include "framework/pipeline/frame_builder.h"
#include "techniques/screen_space_photons/nodes.h"

namespace kaustik {
namespace {

struct CountTexel {  // fragments in the pixel
    static constexpr Format format = Format::r32f;
};
struct DrawCommandWords {
    GLuint words[5];
};

struct Complexity {
    graph::Buffer<transport::LayerStatistics> statistics;
    graph::Texture<CountTexel> counts;
    Geometry geometry;
};

Complexity measureComplexity(FrameBuilder& frame, Geometry geometry, const LayersRequest& request) {
    return frame.pass<Complexity>(
        "layers.complexity", "peeling stops at the measured depth complexity",
        [&](graph::PassSetup& setup, Complexity& data) {
            data.geometry = geometry;
            if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
            data.counts =
                setup.create<CountTexel>(request.name + ".counts", frame.width(), frame.height());
            data.statistics =
                setup.createBuffer<transport::LayerStatistics>(request.name + ".statistics", 1);
        },
        [&inputs = frame.inputs(), request](const Complexity& data, gl::PassContext& context) {
            context.buffer(data.statistics).clear();
            gl::Command count =
                context.shaders({"shared/eye.vert", "screen_space_photons/peel_count.frag"});
            count.set("projection", inputs.view.projection())
                .target(data.counts)
                .clear()
                .blend(gl::Blend::add);
            inputs.gpuScene.draw(count, context, data.geometry, inputs.instances, request.set);
            context.compute("screen_space_photons/peel_statistics.comp")
                .texture("counts", data.counts)
                .storage("Statistics", data.statistics)
                .set("layerCount", request.layers)
                .dispatchOver(inputs.view.width, 8, inputs.view.height, 8);
        });
}

}  // namespace

LayeredDepth peel(FrameBuilder& frame, Geometry geometry, const LayersRequest& request) {
    const int layers = request.layers;
    const Complexity complexity = measureComplexity(frame, geometry, request);
    struct Data {
        LayeredDepth layers;
        graph::Texture<DepthBuffer> depth;
        graph::Buffer<DrawCommandWords> commands;
        Geometry geometry;
    };
    const std::size_t commandCount = frame.gpuScene().commandCount();
    const LayeredDepth peeled =
        frame
            .pass<Data>(
                "layers.peel",
                fmt::format("the tracer needs hidden surfaces; at most {} layers", layers),
                [&](graph::PassSetup& setup, Data& data) {
                    data.geometry = geometry;
                    if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
                    const int w = frame.width();
                    const int h = frame.height();
                    data.layers.depth =
                        setup.create<LayerTexel>(request.name + ".depth", w, h, layers);
                    data.layers.surface =
                        setup.create<SurfaceTexel>(request.name + ".surface", w, h, layers);
                    data.layers.statistics = setup.read(complexity.statistics);
                    data.layers.layers = layers;
                    data.depth = setup.create<DepthBuffer>(request.name + ".depth_buffer", w, h);
                    data.commands = setup.createBuffer<DrawCommandWords>(
                        request.name + ".commands",
                        std::max<std::size_t>(commandCount, 1) * static_cast<std::size_t>(layers));
                },
                [&inputs = frame.inputs(), request, layers, commandCount](
                    const Data& data, gl::PassContext& context) {
                    context.compute("screen_space_photons/peel_commands.comp")
                        .storage("SceneCommands", inputs.gpuScene.commands())
                        .storage("LayerCommands", data.commands)
                        .storage("Statistics", data.layers.statistics)
                        .set("commandCount", static_cast<int>(commandCount))
                        .set("layerCount", layers)
                        .dispatchOver(static_cast<int>(commandCount) * layers, 64);
                    for (int layer = 0; layer < layers; ++layer) {
                        // The layer before is read from the array that this one is written to.
                        glTextureBarrier();
                        gl::Command command =
                            context.shaders({"shared/eye.vert", "screen_space_photons/peel.frag"});
                        inputs.gpuScene.bindMaterials(command);
                        command.set("projection", inputs.view.projection())
                            .set("layer", layer)
                            .texture("layerDepths", data.layers.depth);
                        command.target(data.layers.depth, layer).clear();
                        command.target(data.layers.surface, layer).clear();
                        command.depth(data.depth, gl::DepthTest::nearer).clear({1, 0, 0, 0});
                        inputs.gpuScene.draw(command, context, data.geometry, inputs.instances,
                                             request.set, &context.buffer(data.commands),
                                             static_cast<std::size_t>(layer) * commandCount);
                    }
                })
            .layers;
    return peeled;
}

LayeredDepth peelLayers(FrameBuilder& frame, const params::NoParams&, Geometry geometry) {
    const int layers = frame.params<LayersParams>("layers").count;
    return addPyramid(frame, peel(frame, geometry, {"layers", render::DrawSet::all, layers}));
}

}  // namespace kaustik
