// SPDX-License-Identifier: MIT
#include "techniques/screen_space_photons/hit_testing.h"

namespace kaustik {

HitTesting hitTesting(const FrameBuilder& frame) {
    return {frame.params<TraceParams>("trace"), frame.needs().closedDielectrics,
            frame.needs().nestedBodies};
}

void readLayers(graph::PassSetup& setup, const LayeredDepth& layers) {
    setup.read(layers.depth);
    setup.read(layers.surface);
}

gl::Command& bindHitTesting(gl::Command& command, const HitTesting& testing,
                            const FrameInputs& inputs, const LayeredDepth& layers) {
    if (testing.params.test != HitTest::crossing) command.define("EPSILON_TEST");
    if (testing.params.test == HitTest::inOut) command.define("IN_OUT_TEST");
    // Only what has an inside can be left where no layer's plane is crossed.
    if (testing.hasInside && testing.params.test != HitTest::epsilon)
        command.define("CLOSED_DIELECTRICS");
    if (testing.mayBeNested) command.define("NESTED_BODIES");
    return inputs.bindView(command)
        .params("trace", testing.params)
        .storage("Materials", inputs.gpuScene.materials())
        .texture("layerDepths", layers.depth)
        .texture("layerSurfaces", layers.surface)
        .set("layerCount", layers.layers);
}

}  // namespace kaustik
