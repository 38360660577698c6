// SPDX-License-Identifier: MIT
// A layered depth image by depth peeling (K06, section 2.2). `layers.complexity`
// counts the fragments of every pixel; `layers.peel` then draws as many layers as the fullest pixel
// needs, `layers.count` at most; what lies deeper is counted. Out: arrays of view depth (m) with
// the triangles' normals, and of outward shading normals with materials, front to back. By the
// counts a depth of 0 is stored where each pixel's layers end; memory is cleared for them of cubes
// and of tiles alone. One layer, where nobody asks what lies behind it, is drawn without counting.
#include <fmt/format.h>

#include <utility>

#include "framework/pipeline/frame_builder.h"
#include "techniques/layered_depth/peel_resources.h"

namespace kaustik {
namespace {

struct ReducedCounts {  // x: most fragments in a pixel; y: all; z: skipped; w: pixels with some
    static constexpr Format format = Format::rgba32f;
};

struct Complexity {
    graph::Buffer<transport::LayerStatistics> statistics;
    graph::Texture<CountTexel> counts;
    // The reduce goes back and forth between these.
    graph::Texture<ReducedCounts> half;
    graph::Texture<ReducedCounts> quarter;
    Geometry geometry;
    Views views;
};

int halved(int side) {
    return (side + 1) / 2;
}

// K06: "the maximum over all pixels is then collected by a texture reduce-max operation".
void reduceCounts(const Complexity& data, gl::PassContext& context, int layers, int w, int h) {
    graph::ResourceRef source = data.counts;
    graph::ResourceRef target = data.half;
    graph::ResourceRef spare = data.quarter;
    for (bool isFirst = true; isFirst || w > 1 || h > 1; isFirst = false) {
        w = halved(w);
        h = halved(h);
        context.fullscreen("layered_depth/counts_reduce.frag")
            .texture("source", source)
            .set("layerCount", layers)
            .set("isFirst", isFirst ? 1 : 0)
            .target(target)
            .clear()
            .viewport(0, 0, w, h)
            .draw();
        source = target;
        std::swap(target, spare);
    }
    context.compute("layered_depth/counts_store.comp")
        .texture("reduced", source)
        .storage("Statistics", data.statistics)
        .dispatch(1);
}

}  // namespace

void drawTo(gl::Command& command, const LayersRequest& request) {
    if (request.tile) command.scissor(request.tile->shown.first, request.tile->shown.end);
}

namespace {

// Adds the pass that counts the fragments of every pixel (K06, section 2.2).
const Complexity& measureComplexity(FrameBuilder& frame, Geometry geometry,
                                    const LayersRequest& request) {
    return frame.pass<Complexity>(
        "layers.complexity", "peeling stops at the measured depth complexity",
        [&](graph::PassSetup& setup, Complexity& data) {
            data.geometry = geometry;
            data.views = request.views ? request.views : frame.eyeViews();
            if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
            const int w = data.views->width();
            const int h = data.views->height();
            if (request.reducesCounts)
                needsEyesView("Counting by a reduce", "the view", data.views);
            data.counts = setup.create<CountTexel>(request.name + ".counts", w, h);
            data.statistics =
                setup.createBuffer<transport::LayerStatistics>(request.name + ".statistics", 1);
            if (!request.reducesCounts) return;
            data.half =
                setup.create<ReducedCounts>(request.name + ".counts_half", halved(w), halved(h));
            data.quarter = setup.create<ReducedCounts>(request.name + ".counts_quarter",
                                                       halved(halved(w)), halved(halved(h)));
        },
        [&inputs = frame.inputs(), request](const Complexity& data, gl::PassContext& context) {
            const int w = data.views->width();
            const int h = data.views->height();
            const PixelRegion pixels = request.pixels(*data.views);
            const glm::ivec2 extent = pixels.end - pixels.first;
            if (!request.reducesCounts) context.buffer(data.statistics).clear();
            for (int face = 0; face < data.views->count(); ++face) {
                gl::Command count =
                    context.shaders({"raster_views/eye.vert", "layered_depth/peel_count.frag"});
                count.set("projection", data.views->view(face).projection())
                    .target(data.counts)
                    .clear()
                    .blend(gl::Blend::add);
                drawTo(count, request);
                inputs.gpuScene.draw(count, context, data.geometry, data.views->instances(face),
                                     request.set);
                if (request.reducesCounts) {
                    reduceCounts(data, context, request.layers, w, h);
                    continue;
                }
                context.compute("layered_depth/peel_statistics.comp")
                    .texture("counts", data.counts)
                    .storage("Statistics", data.statistics)
                    .set("layerCount", request.layers)
                    .set("firstPixel", pixels.first)
                    .dispatchOver(extent.x, 8, extent.y, 8);
            }
        });
}

}  // namespace

Peeling Peeling::create(FrameBuilder& frame, graph::PassSetup& setup, Geometry geometry,
                        const LayersRequest& request) {
    Peeling peeling;
    peeling.geometry = geometry;
    if (geometry.heightFields.valid()) setup.read(geometry.heightFields);
    peeling.layers.layers = request.layers;
    peeling.layers.tile = request.tile;
    peeling.layers.views = request.views ? request.views : frame.eyeViews();
    const render::RasterViews& views = *peeling.layers.views;
    const int w = views.width();
    const int h = views.height();
    const int layers = views.layers(request.layers);
    peeling.layers.depth = setup.create<LayerTexel>(request.name + ".depth", w, h, layers);
    peeling.layers.surface = setup.create<SurfaceTexel>(request.name + ".surface", w, h, layers);
    peeling.depth = setup.create<DepthBuffer>(request.name + ".depth_buffer", w, h);
    const std::size_t commandCount = std::max<std::size_t>(frame.gpuScene().commandCount(), 1);
    peeling.commands = setup.createBuffer<DrawCommandWords>(
        request.name + ".commands", commandCount * static_cast<std::size_t>(request.layers) + 1);
    return peeling;
}

namespace {

void clearByTriangle(const FrameInputs& inputs, const Peeling& peeling, gl::PassContext& context,
                     const LayersRequest& request, int index) {
    const std::size_t objectCommands =
        inputs.gpuScene.commandCount() * static_cast<std::size_t>(request.layers);
    // Nothing lies beyond the depth that it has, so that it replaces any other.
    context.shaders({"framework/fullscreen.vert", "layered_depth/peel_blank.frag"})
        .target(peeling.layers.depth, index)
        .target(peeling.layers.surface, index)
        .depth(peeling.depth, gl::DepthTest::nearerReversed)
        .drawIndirect(GL_TRIANGLES, peeling.commands, objectCommands * sizeof(DrawCommandWords));
}

// Where each pixel's layers end, before they are drawn. What is kept, for pictures and scans, is
// whole.
void storeEnds(const Peeling& peeling, gl::PassContext& context) {
    const LayeredDepth& layers = peeling.layers;
    for (const graph::ResourceRef& texture :
         std::initializer_list<graph::ResourceRef>{layers.depth, layers.surface}) {
        if (context.isKept(texture)) context.texture(texture).clear({0, 0, 0, 0});
    }
    context.compute("layered_depth/peel_ends.comp")
        .texture("counts", peeling.counts)
        .image("layerDepths", layers.depth)
        .set("layerCount", layers.layers)
        .dispatchOver(layers.views->width(), 8, layers.views->height(), 8);
}

// The one layer that is asked for, of which nobody asks how many lie behind it.
LayeredDepth drawNearest(FrameBuilder& frame, Geometry geometry, const LayersRequest& request) {
    return frame
        .pass<Peeling>(
            "layers.peel", fmt::format("{} the nearest surface", request.reader),
            [&](graph::PassSetup& setup, Peeling& data) {
                data = Peeling::create(frame, setup, geometry, request);
            },
            [&inputs = frame.inputs(), request](const Peeling& data, gl::PassContext& context) {
                const LayeredDepth& layers = data.layers;
                if (context.isKept(layers.surface))
                    context.texture(layers.surface).clear({0, 0, 0, 0});
                for (int face = 0; face < layers.views->count(); ++face) {
                    gl::Command command =
                        context.shaders({"raster_views/eye.vert", "layered_depth/peel.frag"});
                    layers.views->bindTo(command)
                        .set("projection", layers.views->view(face).projection())
                        .set("layer", 0);
                    command.target(layers.depth, face).clear();
                    command.target(layers.surface, face);
                    command.depth(data.depth, gl::DepthTest::nearer).clear({1, 0, 0, 0});
                    drawTo(command, request);
                    inputs.gpuScene.draw(command, context, data.geometry,
                                         layers.views->instances(face), request.set);
                }
            })
        .layers;
}

}  // namespace

void peelView(const FrameInputs& inputs, const Peeling& peeling, gl::PassContext& context,
              const LayersRequest& request, int face) {
    const render::RasterViews& views = *peeling.layers.views;
    const bool isCounted = peeling.counts.valid();
    const bool clears = !isCounted && !peeling.isConditional;
    if (isCounted) storeEnds(peeling, context);
    for (int layer = 0; layer < request.layers; ++layer) {
        const int index = face * request.layers + layer;
        if (peeling.isConditional) clearByTriangle(inputs, peeling, context, request, index);
        // The layer before is read from the array that this one is written to.
        glTextureBarrier();
        gl::Command command = context.shaders({"raster_views/eye.vert", "layered_depth/peel.frag"});
        views.bindTo(command)
            .set("projection", views.view(face).projection())
            .set("layer", layer)
            .set("before", index - 1)
            .texture("layerDepths", peeling.layers.depth);
        if (isCounted) command.define("COUNTED").texture("counts", peeling.counts);
        command.target(peeling.layers.depth, index);
        if (clears) command.clear();
        command.target(peeling.layers.surface, index);
        if (clears) command.clear();
        command.depth(peeling.depth, gl::DepthTest::nearer);
        if (!peeling.isConditional) command.clear({1, 0, 0, 0});
        drawTo(command, request);
        inputs.gpuScene.draw(command, context, peeling.geometry, views.instances(face), request.set,
                             &context.buffer(peeling.commands, gl::Use::drawCommands),
                             static_cast<std::size_t>(layer) * inputs.gpuScene.commandCount());
    }
}

LayeredDepth peel(FrameBuilder& frame, Geometry geometry, const LayersRequest& request) {
    if (request.layers == 1 && !request.countsFragments)
        return drawNearest(frame, geometry, request);
    const Complexity& complexity = measureComplexity(frame, geometry, request);
    return frame
        .pass<Peeling>(
            "layers.peel",
            fmt::format("{} hidden surfaces; at most {} layer{}", request.reader, request.layers,
                        request.layers == 1 ? "" : "s"),
            [&](graph::PassSetup& setup, Peeling& data) {
                data = Peeling::create(frame, setup, geometry, request);
                data.layers.statistics = setup.read(complexity.statistics);
                // Of several views the counts are the last one's; around a tile's pixels there is
                // nothing.
                if (data.layers.views->count() > 1 || request.tile) return;
                data.counts = complexity.counts;
                setup.read(data.counts);
            },
            [&inputs = frame.inputs(), request](const Peeling& data, gl::PassContext& context) {
                const auto commandCount = static_cast<int>(inputs.gpuScene.commandCount());
                context.compute("layered_depth/peel_commands.comp")
                    .storage("SceneCommands", inputs.gpuScene.commands())
                    .storage("LayerCommands", data.commands)
                    .storage("Statistics", data.layers.statistics)
                    .set("commandCount", commandCount)
                    .set("layerCount", request.layers)
                    .dispatchOver(commandCount * request.layers, 64);
                for (int face = 0; face < data.layers.views->count(); ++face)
                    peelView(inputs, data, context, request, face);
            })
        .layers;
}

}  // namespace kaustik
