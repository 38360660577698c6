// SPDX-License-Identifier: MIT
// trace.march, trace.march_compute: each photon's ray followed over the screen a pixel a step,
// every layer looked up, until the first hit (K06, section 2.1: what the paper compares its lines
// with). trace.hierarchical, trace.hierarchical_compute: the same, but squares of pixels whose
// layers the ray cannot hit are skipped. One fragment or one compute thread a photon; all give
// the same hits as trace.lines, whose steps and hit test they share. In: photons and layered depth
// in eye view space, m; out: hits, W that arrive after absorption.
#include <algorithm>
#include <string>

#include "framework/pipeline/frame_builder.h"
#include "techniques/screen_space_photons/hit_testing.h"
#include "techniques/screen_space_photons/march_params.h"
#include "techniques/screen_space_photons/nodes.h"

namespace kaustik {
namespace {

// With 0 for as many steps as the longer side has pixels.
MarchParams withSteps(const LayeredDepth& layers, MarchParams params) {
    if (params.steps == 0) params.steps = std::max(layers.views->width(), layers.views->height());
    return params;
}

// One fragment a photon, or one compute thread a photon where the shader is one of those.
Hits march(FrameBuilder& frame, const std::string& node, const std::string& shader,
           const std::string& why, const MarchParams& wanted, const Photons& photons,
           const LayeredDepth& layers) {
    const std::string name = "trace." + node;
    const MarchParams params = withSteps(layers, wanted);
    const bool isHierarchical = node.starts_with("hierarchical");
    const bool isThread = shader.ends_with(".comp");
    keepToSteps(frame, name, name + ".steps", params.steps, layers);
    return frame.pass<Hits>(
        name, why,
        [&](graph::PassSetup& setup, Hits& hits) {
            readLayers(setup, layers);
            if (isHierarchical) setup.sample("layerPyramid", layers.pyramid);
            photons.sample(setup);
            hits = Hits::create(setup, photons);
            hits.incoming.account(setup);
            if (isThread) hits.store(setup);
        },
        [testing = hitTesting(frame), name, shader, params, isThread, layers](
            const Hits& hits, gl::PassContext& context) {
            const std::string file = "screen_space_photons/" + shader;
            gl::Command command = isThread ? context.compute(file)
                                           : context.shaders({"framework/photon_rows.vert", file});
            setHitTesting(command, testing, layers).params(name, params);
            if (isThread) return dispatchOver(command, hits.incoming);
            for (const graph::ResourceRef& texture : hits.textures())
                command.target(texture);
            drawOver(command);
        });
}

Hits traceMarch(FrameBuilder& frame, const MarchParams& params, Photons photons,
                Surfaces surfaces) {
    return march(frame, "march", "march.frag", "one fragment a photon follows its ray", params,
                 photons, surfaces.layers);
}

Hits traceMarchCompute(FrameBuilder& frame, const MarchParams& params, Photons photons,
                       Surfaces surfaces) {
    return march(frame, "march_compute", "march.comp", "one thread a photon follows its ray",
                 params, photons, surfaces.layers);
}

Hits traceHierarchical(FrameBuilder& frame, const MarchParams& params, Photons photons,
                       Surfaces surfaces) {
    return march(frame, "hierarchical", "hierarchical.frag",
                 "one fragment a photon follows its ray", params, photons, surfaces.layers);
}

Hits traceHierarchicalCompute(FrameBuilder& frame, const MarchParams& params, Photons photons,
                              Surfaces surfaces) {
    return march(frame, "hierarchical_compute", "hierarchical.comp",
                 "one thread a photon follows its ray", params, photons, surfaces.layers);
}

}  // namespace

void registerMarch(Registry& registry) {
    registry.node<TraceStage>("march",
                              {"Follows each photon's ray over the screen in a fragment shader, "
                               "a pixel a step, to its first hit.",
                               "K06, section 2.1, the comparison"},
                              &traceMarch);
    registry.node<TraceStage>(
        "march_compute",
        {"The same in a compute shader, one thread a photon.", "K06, section 2.1, the comparison"},
        &traceMarchCompute);
    registry.node<TraceStage>("hierarchical",
                              {"Follows each photon's ray in a fragment shader and skips "
                               "squares of pixels whose layers it cannot hit.",
                               ""},
                              &traceHierarchical);
    registry.node<TraceStage>("hierarchical_compute",
                              {"The same in a compute shader, one thread a photon.", ""},
                              &traceHierarchicalCompute);
}

}  // namespace kaustik
