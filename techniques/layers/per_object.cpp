// SPDX-License-Identifier: MIT
// layers.per_object: a layered depth image by peeling every object by itself (K06, section 2.2:
// "separate depth images for each object should be favored to reduce geometry load"). An object is
// drawn once to count its own depth complexity and then as often as that says, instead of as often
// as all objects together are deep; each of its layers is merged into the picture's, front to back.
// Out: as layers.peel.
#include <fmt/format.h>

#include <algorithm>

#include "framework/pipeline/frame_builder.h"
#include "framework/pipeline/stage_params.h"
#include "techniques/layered_depth/depth_peeling.h"
#include "techniques/layered_depth/peel_resources.h"
#include "techniques/layered_depth/pyramid.h"

namespace kaustik {
namespace {

struct ObjectComplexity {
    GLuint layers;
};

// No pixel shows more layers of an object than it has triangles.
int maxLayers(const scene::Scene& scene, std::size_t object, int allowed) {
    const std::size_t triangles = scene.meshes[scene.objects[object].mesh].triangles.size();
    return static_cast<int>(std::min(triangles, static_cast<std::size_t>(allowed)));
}

LayeredDepth peelObjects(FrameBuilder& frame, const params::NoParams&, Geometry geometry) {
    const int layers = frame.params<LayersParams>("layers").count;
    const graph::Buffer<transport::LayerStatistics> statistics =
        measureComplexity(frame, geometry, {"layers", render::DrawSet::all, layers});
    struct Data {
        LayeredDepth layers;
        graph::Texture<LayerTexel> objectDepth;  // array of two: the layer before, and this one
        graph::Texture<SurfaceTexel> objectSurface;
        graph::Texture<CountTexel> counts;
        graph::Texture<DepthBuffer> depth;
        graph::Buffer<ObjectComplexity> complexities;
        graph::Buffer<DrawCommandWords> commands;
        Geometry geometry;
    };
    const std::size_t commandCount = frame.gpuScene().commandCount();
    const LayeredDepth peeled =
        frame
            .pass<Data>(
                "layers.per_object",
                fmt::format("the tracer needs hidden surfaces; {} objects, at most {} layers",
                            commandCount, layers),
                [&](graph::PassSetup& setup, Data& data) {
                    data.geometry = geometry;
                    if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
                    data.layers.views = frame.eyeViews();
                    const int w = frame.width();
                    const int h = frame.height();
                    data.layers.depth = setup.create<LayerTexel>("layers.depth", w, h, layers);
                    data.layers.surface =
                        setup.create<SurfaceTexel>("layers.surface", w, h, layers);
                    data.layers.statistics = setup.read(statistics);
                    data.layers.layers = layers;
                    data.objectDepth = setup.create<LayerTexel>("layers.object_depth", w, h, 2);
                    data.objectSurface = setup.create<SurfaceTexel>("layers.object_surface", w, h);
                    data.counts = setup.create<CountTexel>("layers.object_counts", w, h);
                    data.depth = setup.create<DepthBuffer>("layers.depth_buffer", w, h);
                    const std::size_t objects = std::max<std::size_t>(commandCount, 1);
                    data.complexities =
                        setup.createBuffer<ObjectComplexity>("layers.object_complexities", objects);
                    data.commands = setup.createBuffer<DrawCommandWords>(
                        "layers.commands", objects * static_cast<std::size_t>(layers));
                },
                [&inputs = frame.inputs(), layers, commandCount](const Data& data,
                                                                 gl::PassContext& context) {
                    const glm::mat4 projection = inputs.view.projection();
                    context.buffer(data.complexities).clear();
                    for (const graph::ResourceRef& handle :
                         std::initializer_list<graph::ResourceRef>{
                             data.layers.depth, data.layers.surface, data.objectDepth}) {
                        context.texture(handle).clear({0, 0, 0, 0});
                    }
                    for (std::size_t object = 0; object < commandCount; ++object) {
                        gl::Command count = context.shaders(
                            {"raster_views/eye.vert", "layered_depth/peel_count.frag"});
                        count.set("projection", projection)
                            .target(data.counts)
                            .clear()
                            .blend(gl::Blend::add);
                        inputs.gpuScene.drawOne(count, context, data.geometry, inputs.instances,
                                                object);
                        context.compute("layers/per_object_complexity.comp")
                            .texture("counts", data.counts)
                            .storage("Complexities", data.complexities)
                            .set("object", static_cast<int>(object))
                            .dispatchOver(inputs.view.width, 8, inputs.view.height, 8);
                    }
                    context.compute("layered_depth/peel_commands.comp")
                        .define("PER_OBJECT")
                        .storage("SceneCommands", inputs.gpuScene.commands())
                        .storage("LayerCommands", data.commands)
                        .storage("Complexities", data.complexities)
                        .set("commandCount", static_cast<int>(commandCount))
                        .set("layerCount", layers)
                        .dispatchOver(static_cast<int>(commandCount) * layers, 64);
                    for (std::size_t object = 0; object < commandCount; ++object) {
                        const int maximum = maxLayers(inputs.gpuScene.scene(),
                                                      inputs.gpuScene.objectOf(object), layers);
                        for (int layer = 0; layer < maximum; ++layer) {
                            glTextureBarrier();
                            gl::Command command = context.shaders(
                                {"raster_views/eye.vert", "layered_depth/peel.frag"});
                            command.set("projection", projection)
                                .set("layer", layer)
                                .set("before", (layer + 1) % 2)
                                .texture("layerDepths", data.objectDepth);
                            command.target(data.objectDepth, layer % 2).clear();
                            command.target(data.objectSurface).clear();
                            command.depth(data.depth, gl::DepthTest::nearer).clear({1, 0, 0, 0});
                            inputs.gpuScene.drawOne(
                                command, context, data.geometry, inputs.instances, object,
                                &context.buffer(data.commands, gl::Use::drawCommands),
                                static_cast<std::size_t>(layer) * commandCount);
                            context.compute("layers/per_object_merge.comp")
                                .texture("objectDepths", data.objectDepth)
                                .texture("objectSurface", data.objectSurface)
                                .storage("Complexities", data.complexities)
                                .image("layerDepths", data.layers.depth)
                                .image("layerSurfaces", data.layers.surface)
                                .set("object", static_cast<int>(object))
                                .set("layer", layer)
                                .set("layerCount", layers)
                                .dispatchOver(inputs.view.width, 8, inputs.view.height, 8);
                        }
                    }
                })
            .layers;
    return addPyramid(frame, peeled);
}

}  // namespace

void registerLayersPerObject(Registry& registry) {
    registry.node<LayersStage>(
        "per_object",
        {"Peels every object by itself, no deeper than it is, and merges "
         "them: less geometry where many objects overlap.",
         "K06, section 2.2",
         "It shows the same surfaces as layers.peel and shares its limits. It saves geometry but "
         "no memory, since the layers of all objects are merged into one image."},
        &peelObjects);
}

}  // namespace kaustik
