// SPDX-License-Identifier: MIT
// trace.bvh: the exact first hit of every photon, through a hierarchy over the scene's triangles on
// the device (framework/transport/bvh.h): as trace.raytraced, without a way to the processor and
// back. In: photons, eye view space, m; out: hits, W that arrive after absorption. It sees what no
// view shows, and reads no layers.
#include <fmt/format.h>

#include "techniques/tracing/bvh_rays.h"

namespace kaustik {
namespace {

Hits traceBvh(FrameBuilder& frame, const params::NoParams&, Photons photons, Surfaces surfaces) {
    const BvhOfFrame bvh = bvhOfFrame(frame, surfaces.geometry);
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

}  // namespace

void registerTraceBvh(Registry& registry) {
    registry.node<TraceStage>(
        "bvh",
        {"Exact first hits by ray tracing on the device, through a hierarchy over all triangles.",
         "",
         "The hierarchy is built on the processor once, in 0.3 s for 200,000 triangles, and takes "
         "112 bytes for each of them and 64 for each of its nodes; where water moves it is fitted "
         "anew in each frame."},
        {.reach = TracerReach::everything, .bothSides = true}, &traceBvh);
}

}  // namespace kaustik
