// SPDX-License-Identifier: MIT
// trace.march, trace.march_compute: each photon's ray followed over the screen a pixel a step,
// every layer looked up, until the first hit (K06, section 2.1: what the paper compares its lines
// with). trace.hierarchical, trace.hierarchical_compute: the same, but squares of pixels whose
// layers the ray cannot meet are left out. One fragment or one compute thread a photon; all give
// the same hits as trace.lines, whose steps and hit test they share. In: photons and layered depth
// in eye view space, m; out: hits, W that arrive after absorption.
#include <algorithm>

#include "framework/pipeline/frame_builder.h"
#include "techniques/screen_space_photons/hit_testing.h"
#include "techniques/screen_space_photons/nodes.h"

namespace kaustik {
namespace {

struct Marched {
    Hits hits;
    LayeredDepth layers;
};

// `issue` sets what differs: the parameters, the outputs and the last call.
template <class Issue>
Hits addMarch(FrameBuilder& frame, const std::string& name, const std::string& why,
              const std::vector<std::string>& shaders, bool isHierarchical, int steps,
              const Photons& photons, const LayeredDepth& layers, const Hits& previous,
              Issue issue) {
    const HitTesting testing = hitTesting(frame);
    keepToSteps(frame, name, name + ".steps", steps);
    return frame
        .pass<Marched>(
            name, why,
            [&](graph::PassSetup& setup, Marched& data) {
                data.layers = layers;
                readLayers(setup, layers);
                if (isHierarchical) setup.read(layers.pyramid);
                data.hits.incoming = photons;
                setup.read(photons.position);
                setup.read(photons.direction);
                setup.read(photons.flux);
                data.hits.position = setup.write(previous.position);
                data.hits.surface = setup.write(previous.surface);
                data.hits.flux = setup.write(previous.flux);
                data.hits.incoming.ledger = setup.write(photons.ledger);
            },
            [&inputs = frame.inputs(), testing, shaders, isHierarchical, issue](
                const Marched& data, gl::PassContext& context) {
                const Photons& incoming = data.hits.incoming;
                gl::Command command = context.shaders(shaders);
                bindHitTesting(command, testing, inputs, data.layers);
                inputs.bindLedger(command, incoming.ledger)
                    .texture("photonPosition", incoming.position)
                    .texture("photonDirection", incoming.direction)
                    .texture("photonFlux", incoming.flux);
                if (isHierarchical) command.texture("layerPyramid", data.layers.pyramid);
                issue(command, data);
            })
        .hits;
}

// A pixel a step at most, unless the parameters say otherwise.
MarchParams withSteps(const FrameBuilder& frame, MarchParams params) {
    if (params.steps == 0) params.steps = std::max(frame.width(), frame.height());
    return params;
}

// One fragment a photon.
Hits inFragments(FrameBuilder& frame, const std::string& node, const std::string& why,
                 bool isHierarchical, const MarchParams& params, const Photons& photons,
                 const LayeredDepth& layers, const Hits& previous) {
    const std::string name = "trace." + node;
    const MarchParams marching = withSteps(frame, params);
    return addMarch(frame, name, why, {"screen_space_photons/" + node + ".frag"}, isHierarchical,
                    marching.steps, photons, layers, previous,
                    [name, marching](gl::Command& command, const Marched& data) {
                        command.params(name, marching)
                            .target(data.hits.position)
                            .target(data.hits.surface)
                            .target(data.hits.flux)
                            .draw();
                    });
}

// One compute thread a photon.
Hits inThreads(FrameBuilder& frame, const std::string& node, const std::string& why,
               bool isHierarchical, const MarchParams& params, const Photons& photons,
               const LayeredDepth& layers, const Hits& previous) {
    const std::string name = "trace." + node + "_compute";
    const MarchParams marching = withSteps(frame, params);
    return addMarch(frame, name, why, {"screen_space_photons/" + node + ".comp"}, isHierarchical,
                    marching.steps, photons, layers, previous,
                    [name, marching](gl::Command& command, const Marched& data) {
                        const Photons& incoming = data.hits.incoming;
                        command.params(name, marching)
                            .image("hitPosition", data.hits.position)
                            .image("hitSurface", data.hits.surface)
                            .image("hitFlux", data.hits.flux)
                            .dispatchOver(incoming.width, 8, incoming.height, 8);
                    });
}

}  // namespace

Hits traceMarch(FrameBuilder& frame, const MarchParams& params, Photons photons,
                LayeredDepth layers, Hits previous) {
    return inFragments(frame, "march", "one fragment a photon follows its ray", false, params,
                       photons, layers, previous);
}

Hits traceMarchCompute(FrameBuilder& frame, const MarchParams& params, Photons photons,
                       LayeredDepth layers, Hits previous) {
    return inThreads(frame, "march", "one thread a photon follows its ray", false, params, photons,
                     layers, previous);
}

Hits traceHierarchical(FrameBuilder& frame, const MarchParams& params, Photons photons,
                       LayeredDepth layers, Hits previous) {
    return inFragments(frame, "hierarchical", "one fragment a photon follows its ray", true, params,
                       photons, layers, previous);
}

Hits traceHierarchicalCompute(FrameBuilder& frame, const MarchParams& params, Photons photons,
                              LayeredDepth layers, Hits previous) {
    return inThreads(frame, "hierarchical", "one thread a photon follows its ray", true, params,
                     photons, layers, previous);
}

}  // namespace kaustik
