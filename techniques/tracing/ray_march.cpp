// SPDX-License-Identifier: MIT
#include "techniques/tracing/ray_march.h"

#include <algorithm>
#include <string>

#include "framework/pipeline/frame_builder.h"
#include "techniques/tracing/hit_testing.h"

namespace kaustik {
namespace {

// With 0 for as many steps as the longer side has pixels.
MarchParams withSteps(const LayeredDepth& layers, MarchParams params) {
    if (params.steps == 0) params.steps = std::max(layers.views->width(), layers.views->height());
    return params;
}

}  // namespace

Hits marchRays(FrameBuilder& frame, const RayMarch& march, const MarchParams& wanted,
               const Photons& photons, const LayeredDepth& layers) {
    const std::string name = "trace." + march.node;
    const MarchParams params = withSteps(layers, wanted);
    const bool isThread = march.shader.ends_with(".comp");
    reportStepLimit(frame, name, name + ".steps", params.steps, layers);
    requireEveryPixel(name + ".steps", params.steps, layers);
    return frame.pass<Hits>(
        name,
        isThread ? "one thread a photon follows its ray" : "one fragment a photon follows its ray",
        [&](graph::PassSetup& setup, Hits& hits) {
            readLayers(setup, layers);
            if (march.skipsSquares) setup.sample("layerPyramid", layers.pyramid);
            photons.sample(setup);
            hits = Hits::create(setup, photons);
            hits.incoming.account(setup);
            if (isThread) hits.store(setup);
            createTileOutput(setup, layers, hits);
        },
        [testing = hitTesting(frame), name, shader = march.shader, params, isThread, layers](
            const Hits& hits, gl::PassContext& context) {
            gl::Command command = isThread
                                      ? context.compute(shader)
                                      : context.shaders({"framework/photon_rows.vert", shader});
            setHitTesting(command, testing, layers).params(name, params);
            if (isThread) return dispatchOver(command, hits.incoming);
            for (const graph::ResourceRef& texture : hits.textures())
                command.target(texture);
            drawOver(command);
        });
}

}  // namespace kaustik
