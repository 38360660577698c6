// SPDX-License-Identifier: MIT
// trace.all_hits: every receiver on a photon's ray is lit, as if none were in the way of the next
// (K06, section 2 and Fig. 3): the wrong picture that the reduce to first hits is for. The transfer
// map gets a slot more for each further hit. Light is made from nothing, and the ledger's balance
// says how much.
#include <fmt/format.h>

#include <algorithm>

#include "framework/core/error.h"
#include "techniques/screen_space_photons/hit_testing.h"
#include "techniques/screen_space_photons/nodes.h"

namespace kaustik {
namespace {

// Which rays may have met more receivers than they could keep.
void keepToSlots(FrameBuilder& frame, const AllHitsParams& params, const Hits& hits) {
    frame.keepsTo(
        {"trace.all_hits", hits.flux,
         [slots = params.slots,
          handle = hits.flux](const gl::Executor& executor) -> std::optional<ReachedLimit> {
             const gl::Texture& flux = executor.texture(handle);
             const int rows = flux.desc().height / slots;
             const std::size_t full =
                 countWithFate(flux, transport::kFateReceiver, (slots - 1) * rows);
             if (full == 0) return {};
             return ReachedLimit{
                 "trace.all_hits.slots",
                 "hits",
                 static_cast<double>(slots),
                 0.0,
                 fmt::format("{} rays have filled all of their slots; what they met behind is not "
                             "lit",
                             full),
                 0.0};
         }});
}

}  // namespace

Hits traceAllHits(FrameBuilder& frame, const AllHitsParams& params, Photons photons,
                  LayeredDepth layers, Hits previous) {
    struct Data {
        Hits before;
        Hits after;
        LayeredDepth layers;
    };
    // The first tracing of a transfer map makes room; later ones find it.
    const bool makesRoom = photons.paths.interactions <= 1;
    if (!makesRoom && photons.height % params.slots != 0) {
        throw ConfigError(
            "trace.all_hits needs a transfer map that keeps its size: set "
            "specular=interface.");
    }
    const int rows = makesRoom ? photons.height : photons.height / params.slots;
    const int run = frame.runsOf(TraceStage::name);
    const HitTesting testing = hitTesting(frame);
    previous.incoming = photons;
    AllHitsParams marching = params;
    if (marching.march.steps == 0) marching.march.steps = std::max(frame.width(), frame.height());
    keepToSteps(frame, "trace.all_hits", "trace.all_hits.steps", marching.march.steps);
    const Data& traced = frame.pass<Data>(
        "trace.all_hits", "every receiver on a ray is lit, for comparison",
        [&](graph::PassSetup& setup, Data& data) {
            data.before = previous;
            data.layers = layers;
            readLayers(setup, layers);
            setup.read(previous.position);
            setup.read(previous.surface);
            setup.read(previous.flux);
            setup.read(photons.position);
            setup.read(photons.direction);
            setup.read(photons.flux);
            Hits& after = data.after;
            Photons& to = after.incoming;
            to = photons;
            to.height = rows * params.slots;
            const int w = photons.width;
            const int h = to.height;
            const auto name = [&](const char* what) { return fmt::format("{}_all_{}", what, run); };
            to.position = setup.create<PhotonPosition>(name("photons.position"), w, h);
            to.direction = setup.create<PhotonDirection>(name("photons.direction"), w, h);
            to.flux = setup.create<PhotonFlux>(name("photons.flux"), w, h);
            after.position = setup.create<HitPosition>(name("hits.position"), w, h);
            after.surface = setup.create<HitSurface>(name("hits.surface"), w, h);
            after.flux = setup.create<HitFlux>(name("hits.flux"), w, h);
            to.ledger = setup.write(photons.ledger);
        },
        [&inputs = frame.inputs(), testing, marching, rows](const Data& data,
                                                            gl::PassContext& context) {
            const Photons& from = data.before.incoming;
            const Photons& to = data.after.incoming;
            gl::Command command = context.compute("screen_space_photons/all_hits.comp");
            bindHitTesting(command, testing, inputs, data.layers);
            inputs.bindLedger(command, to.ledger)
                .params("trace.all_hits", marching)
                .texture("photonPosition", from.position)
                .texture("photonDirection", from.direction)
                .texture("photonFlux", from.flux)
                .texture("keptPosition", data.before.position)
                .texture("keptSurface", data.before.surface)
                .texture("keptFlux", data.before.flux)
                .image("nextPosition", to.position)
                .image("nextDirection", to.direction)
                .image("nextFlux", to.flux)
                .image("hitPosition", data.after.position)
                .image("hitSurface", data.after.surface)
                .image("hitFlux", data.after.flux)
                .set("rows", rows)
                .dispatch((to.width + 7) / 8, (rows + 7) / 8, marching.slots);
        });
    keepToSlots(frame, params, traced.after);
    return traced.after;
}

}  // namespace kaustik
