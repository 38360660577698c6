// SPDX-License-Identifier: MIT
#include "techniques/tracing/processor_scene.h"

#include <span>
#include <utility>
#include <vector>

namespace kaustik {
namespace {

using HeightFields = reference::EmbreeScene::HeightFields;

struct MovedScene {
    graph::Buffer<HasMoved> moved;
    Geometry geometry;
};

void moveHeightFields(const FrameInputs& inputs, const MovedScene& data,
                      reference::EmbreeScene& scene, gl::PassContext& context) {
    const auto vertices = context.buffer(data.geometry.heightFields).read<transport::VertexData>();
    const std::vector<scene::Object>& objects = scene.scene().objects;
    for (const render::GpuScene::HeightFieldRange& range : inputs.gpuScene.heightFields()) {
        const std::size_t count = scene.scene().meshes[range.mesh].positions.size();
        for (std::size_t object = 0; object < objects.size(); ++object) {
            if (objects[object].mesh != range.mesh) continue;
            // What a device that is lost hands out is no water: the frame's end says so.
            static_cast<void>(
                scene.move(object, std::span(vertices).subspan(range.firstVertex, count)));
        }
    }
    scene.refit();
}

ProcessorScene movedScene(FrameBuilder& frame, const Geometry& geometry) {
    const FrameBuilder::PassScope shared(frame);
    const auto scene = frame.onceForScene<reference::EmbreeScene>("processor.moving_scene", [&] {
        return std::make_shared<reference::EmbreeScene>(
            frame.scene(), reference::EmbreeScene::Filters::sideRules, HeightFields::moving);
    });
    const graph::Buffer<HasMoved> moved =
        frame
            .pass<MovedScene>(
                "geometry.embree", "height fields move in what the processor traces",
                [&](graph::PassSetup& setup, MovedScene& data) {
                    data.geometry = geometry;
                    setup.read(data.geometry.heightFields);
                    data.moved = setup.createBuffer<HasMoved>("embree.moved", 1);
                },
                [&inputs = frame.inputs(), scene](const MovedScene& data,
                                                  gl::PassContext& context) {
                    if (!context.isListing()) moveHeightFields(inputs, data, *scene, context);
                    context.buffer(data.moved).clear();
                })
            .moved;
    return {scene, moved};
}

}  // namespace

void ProcessorScene::read(graph::PassSetup& setup) const {
    if (moved.valid()) setup.read(moved);
}

ProcessorScene processorScene(FrameBuilder& frame, const Geometry& geometry) {
    return *frame.once<ProcessorScene>("processor.scene", [&] {
        if (geometry.heightFields.valid())
            return std::make_shared<ProcessorScene>(movedScene(frame, geometry));
        const auto make = [&] { return std::make_shared<reference::EmbreeScene>(frame.scene()); };
        const char* const still = "processor.still_scene";
        auto scene = frame.gpuScene().heightFields().empty()
                         ? frame.onceForScene<reference::EmbreeScene>(still, make)
                         : frame.once<reference::EmbreeScene>(still, make);
        return std::make_shared<ProcessorScene>(ProcessorScene{std::move(scene), {}});
    });
}

}  // namespace kaustik
