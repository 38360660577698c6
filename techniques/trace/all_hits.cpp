// SPDX-License-Identifier: MIT
// trace.all_hits: every receiver on a photon's ray is lit, as if none were in the way of the next
// (K06, section 2 and Fig. 3): the wrong picture that the reduce to first hits is for. The list
// holds every photon once a slot, slot by slot. Light is made from nothing, and the ledger's
// balance says how much.
#include <algorithm>
#include <memory>

#include "framework/pipeline/ledger.h"
#include "techniques/tracing/hit_testing.h"
#include "techniques/tracing/ray_march.h"

namespace kaustik {
namespace {

struct AllHitsParams {
    int slots = 4;
    MarchParams march;
    template <class R>
    void reflect(R& r) {
        r.field(slots, "slots", "Most hits of a ray that are kept", "", params::range(1, 16));
        march.reflect(r);
    }
};

// Which rays may have hit more receivers than they could keep: shaders count them.
void reportSlotLimit(FrameBuilder& frame, const AllHitsParams& params) {
    const auto reached =
        [slots = params.slots](const EnergyLedger& ledger) -> std::optional<ReachedLimit> {
        const std::uint64_t full = ledger.events[transport::kAccountFullSlots];
        if (full == 0) return {};
        return ReachedLimit{"trace.all_hits.slots",
                            "hits",
                            static_cast<double>(slots),
                            0.0,
                            "what they hit beyond is not lit",
                            0.0,
                            "rays have filled all of their slots",
                            full};
    };
    frame.once<bool>("trace.all_hits.limit", [&] {
        frame.reportLimit({"trace.all_hits", {}, {}, reached});
        return std::make_shared<bool>(true);
    });
}

Hits traceAllHits(FrameBuilder& frame, const AllHitsParams& params, Photons photons,
                  Surfaces surfaces) {
    needsEyesView("trace.all_hits", "the layers", surfaces.layers.views);
    AllHitsParams marching = params;
    if (marching.march.steps == 0) marching.march.steps = std::max(frame.width(), frame.height());
    reportStepLimit(frame, "trace.all_hits", "trace.all_hits.steps", marching.march.steps,
                    surfaces.layers);
    const Hits traced = frame.pass<Hits>(
        "trace.all_hits", "every receiver on a ray is lit, for comparison",
        [&](graph::PassSetup& setup, Hits& hits) {
            readLayers(setup, surfaces.layers);
            photons.sample(setup);
            Photons every = Photons::create(setup, photons.width, photons.height * params.slots,
                                            photons.suffix + "_all", photons.extras());
            every.paths = photons.paths;
            every.nextRows = photons.nextRows;
            every.cells.splits = photons.cells.splits;  // no neighbours, but the same room
            every.batch = photons.batch;
            every.ledger = photons.ledger;
            every.store(setup);
            every.account(setup);
            hits = Hits::create(setup, every);
            hits.store(setup);
        },
        [testing = hitTesting(frame), marching, photons, layers = surfaces.layers](
            const Hits& hits, gl::PassContext& context) {
            context.compute("trace/all_hits_list.comp")
                .set("slots", marching.slots)
                .set("nextRowLength", hits.incoming.width)
                .dispatch(1);
            dispatchOver(
                context.compute("trace/all_hits_photons.comp").set("slots", marching.slots),
                photons);
            for (int slot = 0; slot < marching.slots; ++slot) {
                gl::Command command = context.compute("trace/all_hits.comp");
                setHitTesting(command, testing, layers)
                    .params("trace.all_hits", marching)
                    .set("slot", slot);
                dispatchOver(command, photons);
            }
        });
    reportSlotLimit(frame, params);
    return traced;
}

}  // namespace

void registerTraceAllHits(Registry& registry) {
    registry.node<TraceStage>(
        "all_hits",
        {"Lights every receiver on a photon's ray instead of the first: the "
         "wrong picture, for comparison.",
         "K06, section 2, Fig. 3",
         "It is wrong on purpose: light is made from nothing, as the ledger's balance says. No "
         "more than trace.all_hits.slots hits of a ray are kept. It works on the screen alone, and "
         "refuses layers of another view."},
        {.multipliesLight = true}, &traceAllHits);
}

}  // namespace kaustik
