// SPDX-License-Identifier: MIT
// layers.per_object: a layered depth image by peeling every object by itself (K06, section 2.2:
// "separate depth images for each object should be favored to reduce geometry load"). An object is
// drawn once to count its own depth complexity and then as often as that says, instead of as often
// as all objects together are deep, in the part of the picture that its box may cover; each of its
// layers is merged into the picture's, front to back. Out: as layers.peel.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

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

// The pixels that may show some of an object; none where it is not in the picture.
PixelRegion pixelsOf(const scene::Scene& scene, std::size_t object, const render::RasterView& eye) {
    const PixelRegion all{{0, 0}, {eye.width, eye.height}};
    const scene::Bounds box = objectBounds(scene, scene.objects[object]);
    if (box.empty) return {{0, 0}, {0, 0}};
    glm::dvec2 low(1e300);
    glm::dvec2 high(-1e300);
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner((i & 1U) != 0 ? box.maximum.x : box.minimum.x,
                                (i & 2U) != 0 ? box.maximum.y : box.minimum.y,
                                (i & 4U) != 0 ? box.maximum.z : box.minimum.z);
        const std::optional<glm::dvec2> pixel =
            render::pixelOf(eye, glm::dvec3(eye.worldToView * glm::dvec4(corner, 1.0)));
        // What reaches behind the eye may be anywhere.
        if (!pixel) return all;
        low = glm::min(low, *pixel);
        high = glm::max(high, *pixel);
    }
    // A rasteriser may round vertices to either side.
    constexpr double kMargin = 2.0;
    const glm::dvec2 size(all.end);
    return {glm::ivec2(glm::clamp(glm::floor(low - kMargin), glm::dvec2(0.0), size)),
            glm::ivec2(glm::clamp(glm::ceil(high + kMargin), glm::dvec2(0.0), size))};
}

struct PeeledObjects {
    LayeredDepth layers;
    graph::Texture<LayerTexel> objectDepth;  // array of two: the layer before, and this one
    graph::Texture<SurfaceTexel> objectSurface;
    graph::Texture<CountTexel> counts;     // of an object
    graph::Texture<CountTexel> allCounts;  // of all
    graph::Texture<DepthBuffer> depth;
    graph::Buffer<ObjectComplexity> complexities;
    graph::Buffer<DrawCommandWords> commands;
    Geometry geometry;
};

bool isEmpty(const PixelRegion& region) {
    return region.end.x <= region.first.x || region.end.y <= region.first.y;
}

// Each object's own depth complexity, and what is known of all fragments together.
void countObjects(const FrameInputs& inputs, const PeeledObjects& data, gl::PassContext& context,
                  const std::vector<PixelRegion>& regions) {
    context.buffer(data.complexities).clear();
    context.buffer(data.layers.statistics).clear();
    context.texture(data.counts).clear({0, 0, 0, 0});
    context.texture(data.allCounts).clear({0, 0, 0, 0});
    for (std::size_t object = 0; object < regions.size(); ++object) {
        const PixelRegion& region = regions[object];
        if (isEmpty(region)) continue;
        gl::Command count =
            context.shaders({"raster_views/eye.vert", "layered_depth/peel_count.frag"});
        count.set("projection", inputs.view.projection())
            .target(data.counts)
            .clear()
            .blend(gl::Blend::add)
            .bounds(region.first, region.end);
        inputs.gpuScene.drawOne(count, context, data.geometry, inputs.instances, object);
        const glm::ivec2 extent = region.end - region.first;
        context.compute("layers/per_object_complexity.comp")
            .texture("counts", data.counts)
            .image("allCounts", data.allCounts)
            .storage("Complexities", data.complexities)
            .set("object", static_cast<int>(object))
            .set("firstPixel", region.first)
            .set("endPixel", region.end)
            .dispatchOver(extent.x, 8, extent.y, 8);
    }
    context.compute("layered_depth/peel_statistics.comp")
        .texture("counts", data.allCounts)
        .storage("Statistics", data.layers.statistics)
        .set("layerCount", data.layers.layers)
        .set("firstPixel", glm::ivec2(0))
        .dispatchOver(inputs.view.width, 8, inputs.view.height, 8);
}

void peelObject(const FrameInputs& inputs, const PeeledObjects& data, gl::PassContext& context,
                const std::vector<PixelRegion>& regions, std::size_t object) {
    const PixelRegion& region = regions[object];
    if (isEmpty(region)) return;
    const glm::ivec2 extent = region.end - region.first;
    const int maximum =
        maxLayers(inputs.gpuScene.scene(), inputs.gpuScene.objectOf(object), data.layers.layers);
    for (int layer = 0; layer < maximum; ++layer) {
        glTextureBarrier();
        gl::Command command = context.shaders({"raster_views/eye.vert", "layered_depth/peel.frag"});
        command.set("projection", inputs.view.projection())
            .set("layer", layer)
            .set("before", (layer + 1) % 2)
            .texture("layerDepths", data.objectDepth);
        command.target(data.objectDepth, layer % 2).clear();
        command.target(data.objectSurface).clear();
        command.depth(data.depth, gl::DepthTest::nearer).clear({1, 0, 0, 0});
        command.bounds(region.first, region.end);
        inputs.gpuScene.drawOne(command, context, data.geometry, inputs.instances, object,
                                &context.buffer(data.commands, gl::Use::drawCommands),
                                static_cast<std::size_t>(layer) * regions.size());
        context.compute("layers/per_object_merge.comp")
            .texture("objectDepths", data.objectDepth)
            .texture("objectSurface", data.objectSurface)
            .storage("Complexities", data.complexities)
            .image("layerDepths", data.layers.depth)
            .image("layerSurfaces", data.layers.surface)
            .set("object", static_cast<int>(object))
            .set("layer", layer)
            .set("layerCount", data.layers.layers)
            .set("firstPixel", region.first)
            .set("endPixel", region.end)
            .dispatchOver(extent.x, 8, extent.y, 8);
    }
}

LayeredDepth peelObjects(FrameBuilder& frame, const params::NoParams&, Geometry geometry) {
    const int layers = frame.params<LayersParams>("layers").count;
    using Data = PeeledObjects;
    const std::size_t commandCount = frame.gpuScene().commandCount();
    std::vector<PixelRegion> regions;
    for (std::size_t i = 0; i < commandCount; ++i)
        regions.push_back(pixelsOf(frame.scene(), frame.gpuScene().objectOf(i), frame.view()));
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
                    data.layers.statistics =
                        setup.createBuffer<transport::LayerStatistics>("layers.statistics", 1);
                    data.layers.layers = layers;
                    data.objectDepth = setup.create<LayerTexel>("layers.object_depth", w, h, 2);
                    data.objectSurface = setup.create<SurfaceTexel>("layers.object_surface", w, h);
                    data.counts = setup.create<CountTexel>("layers.object_counts", w, h);
                    data.allCounts = setup.create<CountTexel>("layers.counts", w, h);
                    data.depth = setup.create<DepthBuffer>("layers.depth_buffer", w, h);
                    const std::size_t objects = std::max<std::size_t>(commandCount, 1);
                    data.complexities =
                        setup.createBuffer<ObjectComplexity>("layers.object_complexities", objects);
                    data.commands = setup.createBuffer<DrawCommandWords>(
                        "layers.commands", objects * static_cast<std::size_t>(layers));
                },
                [&inputs = frame.inputs(), layers, regions](const Data& data,
                                                            gl::PassContext& context) {
                    countObjects(inputs, data, context, regions);
                    const auto regionCount = static_cast<int>(regions.size());
                    context.compute("layered_depth/peel_commands.comp")
                        .define("PER_OBJECT")
                        .storage("SceneCommands", inputs.gpuScene.commands())
                        .storage("LayerCommands", data.commands)
                        .storage("Complexities", data.complexities)
                        .set("commandCount", regionCount)
                        .set("layerCount", layers)
                        .dispatchOver(regionCount * layers, 64);
                    // Beyond an object's own pixels nothing is drawn or cleared.
                    for (const graph::ResourceRef& handle :
                         std::initializer_list<graph::ResourceRef>{
                             data.layers.depth, data.layers.surface, data.objectDepth,
                             data.objectSurface}) {
                        context.texture(handle).clear({0, 0, 0, 0});
                    }
                    context.texture(data.depth).clear({1, 0, 0, 0});
                    for (std::size_t object = 0; object < regions.size(); ++object)
                        peelObject(inputs, data, context, regions, object);
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
