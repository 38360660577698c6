// SPDX-License-Identifier: MIT
#include "techniques/tracing/bvh_rays.h"

#include <fmt/format.h>

#include <algorithm>

namespace kaustik {
namespace {

struct MovedBvh {
    BvhOfFrame bvh;
    graph::Buffer<BvhNodeBounds> bounds;
    Geometry geometry;
};

void makeCorners(const MovedBvh& data, const FrameInputs& inputs,
                 const render::ViewInstances& instances, gl::PassContext& context) {
    const render::SceneBvh& still = inputs.gpuScene.bvh();
    // Of what does not move: read by the shader it would take longer than all the rest.
    still.corners().copyTo(context.buffer(data.bvh.corners));
    gl::Command command = context.compute("tracing/bvh_corners.comp");
    inputs.gpuScene.bindTriangles(command, data.geometry);
    command.storage("BvhSources", still.sources())
        .storage("LocalInstances", instances.instances)
        .storage("BvhCorners", data.bvh.corners)
        .set("triangleCount", static_cast<unsigned>(still.triangleCount()))
        .dispatchOver(static_cast<int>(still.triangleCount()), 64);
}

// From the leaves up: a level needs that below it.
void refit(const MovedBvh& data, const FrameInputs& inputs, gl::PassContext& context) {
    const render::SceneBvh& still = inputs.gpuScene.bvh();
    for (auto level = still.levels().rbegin(); level != still.levels().rend(); ++level) {
        context.compute("tracing/bvh_refit.comp")
            .texels("stillNodes", still.nodes(), Format::rgba32ui)
            .texels("bvhCorners", data.bvh.corners, Format::rgba32f)
            .storage("BvhBounds", data.bounds)
            .storage("BvhNodes", data.bvh.nodes)
            .set("firstNode", static_cast<unsigned>(level->first))
            .set("nodeCount", static_cast<unsigned>(level->count))
            .dispatchOver(static_cast<int>(level->count), 64);
    }
}

BvhOfFrame movedBvh(FrameBuilder& frame, const Geometry& geometry) {
    const FrameBuilder::PassScope shared(frame);
    const render::SceneBvh& still = frame.gpuScene().bvh();
    const auto instances = frame.once<render::ViewInstances>("tracing.bvh.instances", [&] {
        return std::make_shared<render::ViewInstances>(
            frame.gpuScene().makeInstances(still.worldToLocal()));
    });
    return frame
        .pass<MovedBvh>(
            "geometry.bvh",
            fmt::format("height fields move among {} triangles", still.triangleCount()),
            [&](graph::PassSetup& setup, MovedBvh& data) {
                data.geometry = geometry;
                setup.read(data.geometry.heightFields);
                data.bvh.nodes =
                    setup.createBuffer<transport::BvhNode>("bvh.nodes", still.nodeCount());
                data.bvh.corners = setup.createBuffer<transport::VertexData>(
                    "bvh.corners", 3 * still.triangleCount());
                data.bounds = setup.createBuffer<BvhNodeBounds>("bvh.bounds", still.nodeCount());
            },
            [&inputs = frame.inputs(), instances](const MovedBvh& data, gl::PassContext& context) {
                makeCorners(data, inputs, *instances, context);
                refit(data, inputs, context);
            })
        .bvh;
}

// Programs for depths that differ a little are the same.
std::string stackOf(std::size_t size) {
    return fmt::format("BVH_STACK {}", (size + 15) / 16 * 16);
}

}  // namespace

void BvhOfFrame::read(graph::PassSetup& setup) const {
    if (!nodes.valid()) return;
    setup.read(nodes);
    setup.read(corners);
}

void BvhOfFrame::bindTo(gl::Command& command, const FrameInputs& inputs) const {
    const render::SceneBvh& still = inputs.gpuScene.bvh();
    const auto bind = [&](const auto& nodesNow, const auto& cornersNow) {
        command.texels("bvhNodes", nodesNow, Format::rgba32ui)
            .texels("bvhCorners", cornersNow, Format::rgba32f);
    };
    nodes.valid() ? bind(nodes, corners) : bind(still.nodes(), still.corners());
    command.storage("BvhSources", still.sources())
        .set("localFromEye",
             glm::mat4(still.worldToLocal() * glm::inverse(inputs.view.worldToView)))
        .set("localRounding", still.roundingMeters())
        .define(stackOf(still.stackSize()));
}

BvhOfFrame bvhOfFrame(FrameBuilder& frame, const Geometry& geometry) {
    return *frame.once<BvhOfFrame>("tracing.bvh", [&] {
        const bool isMoving = frame.gpuScene().bvh().isMoving() && geometry.heightFields.valid();
        return std::make_shared<BvhOfFrame>(isMoving ? movedBvh(frame, geometry) : BvhOfFrame{});
    });
}

Hits hitsByBvh(FrameBuilder& frame, const Photons& photons, const Geometry& geometry) {
    const BvhOfFrame bvh = bvhOfFrame(frame, geometry);
    return frame.pass<Hits>(
        "trace.bvh",
        fmt::format("one thread a photon, through {} triangles in a tree of {} levels",
                    frame.gpuScene().bvh().triangleCount(), frame.gpuScene().bvh().levels().size()),
        [&](graph::PassSetup& setup, Hits& hits) {
            photons.sample(setup);
            bvh.read(setup);
            hits = Hits::create(setup, photons);
            hits.incoming.account(setup);
            hits.store(setup);
        },
        [&inputs = frame.inputs(), bvh](const Hits& hits, gl::PassContext& context) {
            gl::Command command = context.compute("trace/bvh.comp");
            bvh.bindTo(command, inputs);
            dispatchOver(command, hits.incoming);
        });
}

}  // namespace kaustik
