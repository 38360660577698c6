// SPDX-License-Identifier: MIT
// trace.secant: photons that have left a caustic generator meet what lies around it, by search in
// its layers of distance (U08, section 3): linear for a change from before a surface to beyond it,
// then by secants, and a residual that the end must pass. In: photons, eye view space, m, and the
// surfaces around each generator (stage `around`); a photon that meets another generator goes on
// from there. Out: hits, W that arrive after absorption. Misses: beyond_last_layer, where a ray
// ends beyond as many surfaces as there are slots, else unresolved.
#include <fmt/format.h>

#include "framework/pipeline/frame_builder.h"
#include "techniques/generators/around_stage.h"
#include "techniques/generators/generators.h"
#include "techniques/tracing/hit_testing.h"

namespace kaustik {
namespace {

struct SecantParams {
    float stride = 4.0f;
    int maxSteps = 256;
    int refinements = 8;
    template <class R>
    void reflect(R& r) {
        r.field(stride, "stride",
                "Texels that a step of the linear search spans, as the reference point sees it: "
                "thinner surfaces may be missed",
                "texels", params::range(0.1f, 64.0f));
        r.field(maxSteps, "max_steps", "Steps of a ray at most, each the wider", "",
                params::range(2, 4096));
        r.renamed("most", "max_steps");
        r.field(refinements, "refinements", "Looks within the step that the surface is in", "",
                params::range(1, 32));
    }
};

// A ray that sees half of all directions takes so many steps.
void reportStepLimit(FrameBuilder& frame, const SecantParams& params, const LayeredDepth& layers) {
    const float wanted = 2.0f * static_cast<float>(layers.views->width()) / params.stride;
    if (static_cast<float>(params.maxSteps) >= wanted) return;
    const ReachedLimit limit{
        "trace.secant.max_steps",
        "steps",
        static_cast<double>(params.maxSteps),
        static_cast<double>(wanted),
        fmt::format("rays across half of all directions take steps of more than {:.3g} texels",
                    params.stride),
        0.0};
    frame.reportLimit({"trace.secant", {}, [limit](const gl::Executor&) { return limit; }});
}

Hits traceSecant(FrameBuilder& frame, const SecantParams& params, Photons photons,
                 Surfaces surfaces) {
    const std::vector<Generator>& generators = causticGenerators(frame);
    const std::vector<SurfacesAround>& around = surfacesAround(frame, surfaces.geometry);
    reportStepLimit(frame, params, around.front().layers);
    Hits hits;
    for (std::size_t i = 0; i < around.size(); ++i) {
        const LayeredDepth& layers = around[i].layers;
        hits = frame.pass<Hits>(
            "trace.secant",
            fmt::format("photons that leave '{}' look for what lies around it", generators[i].name),
            [&](graph::PassSetup& setup, Hits& data) {
                photons.sample(setup);
                readLayers(setup, layers);
                setup.sample("layerOrder", around[i].order);
                if (i == 0) {
                    data = Hits::create(setup, photons);
                } else {
                    data = hits;
                    data.rewrite(setup);
                }
                data.incoming.account(setup);
                data.store(setup);
            },
            [params, i, layers, testing = hitTesting(frame), &block = generatorsBlock(frame)](
                const Hits& data, gl::PassContext& context) {
                gl::Command command = context.compute("trace/secant.comp");
                setHitTesting(command, testing, layers)
                    .params("trace.secant", params)
                    .uniforms("Generators", block)
                    .set("generatorIndex", static_cast<int>(i));
                dispatchOver(command, data.incoming);
            });
    }
    return hits;
}

}  // namespace

void registerTraceSecant(Registry& registry) {
    registry.node<TraceStage>(
        "secant",
        {"Searches the layers around the generator that a photon has left, "
         "linearly and by secants.",
         "U08, section 3",
         "It finds what the layers around a generator hold: nothing that its reference point does "
         "not see, and no more surfaces in a direction than there are layers. A surface thinner "
         "than a step of the linear search may be missed.",
         {"around"}},
        {TracerReach::around}, &traceSecant);
}

}  // namespace kaustik
