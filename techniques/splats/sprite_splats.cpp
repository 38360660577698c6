// SPDX-License-Identifier: MIT
#include "techniques/splats/sprite_splats.h"

#include <algorithm>

#include "techniques/splats/clamped.h"

namespace kaustik {
namespace {

// Splats that a parameter has cut off, and those that one has made smaller, as
// shaders/splats/sprite_totals.comp has them.
using ClampedSplats = graph::Buffer<transport::Clamped>;
constexpr std::size_t kCutOff = 0;
constexpr std::size_t kShrunk = 1;

// Of a cube a splat may touch three faces, and Mesa's software rasteriser ends all loops of a
// thread after 65,535 turns together.
constexpr int kMaxReachOnCubes = 72;

}  // namespace

Stored splatInto(FrameBuilder& frame, const Splatting& splatting, const Hits& hits,
                 const Store& store, const FluxMap& before) {
    const SpritesParams& params = splatting.params;
    const ReceiverView& receivers = store.receivers;
    const FluxSets sets = setsIn(frame, store);
    const bool isGlossy = sets.hasIntensity();
    const int reach = receivers.views->count() == 1
                          ? params.reachPixels
                          : std::min(params.reachPixels, kMaxReachOnCubes);
    struct Data {
        ClampedSplats clamped;
        Stored stored;
    };
    const Data& splatted = frame.pass<Data>(
        splatting.node,
        isGlossy ? "photons deposit flux at the receivers, and, since some are glossy, how it "
                   "goes to the eye"
                 : "photons deposit flux at the receivers",
        [&](graph::PassSetup& setup, Data& data) {
            data.stored = depositIn(setup, store, hits, before, sets);
            data.clamped = setup.storage(
                "ClampedWidths", setup.createBuffer<transport::Clamped>(
                                     "splats.clamped" + store.suffix + hits.incoming.suffix, 2));
            setup.bypass(data.clamped, {0, 0, 0, 0});
            setup.bypass(setup.storage("SplatTotals",
                                       setup.createBuffer<float>(
                                           "splats.totals" + store.suffix + hits.incoming.suffix,
                                           static_cast<std::size_t>(hits.incoming.capacity()))),
                         {0, 0, 0, 0});
        },
        [splatting, reach, sets, store, list = hits.incoming](const Data& data,
                                                              gl::PassContext& context) {
            if (!context.isRepeated()) context.buffer(data.clamped).clear();
            clearIfFirst(context, data.stored);
            for (const char* shader : {"splats/sprite_totals.comp", "splats/sprites.comp"}) {
                gl::Command command = context.compute(shader);
                bindStore(command, store).params("reconstruct.sprites", splatting.params);
                command.set("maxReach", reach);
                if (splatting.areBeams)
                    command.define("BEAM_SPLATS").set("isRound", splatting.areRound ? 1 : 0);
                if (shader == std::string("splats/sprites.comp")) setDeposit(command, sets);
                dispatchOver(command, list);
            }
        });
    WidthLimit limit{splatting.node,
                     "reach",
                     WidthBound::largest,
                     static_cast<double>(reach),
                     "px",
                     "splats are cut off",
                     store.cascade > 0};
    reportWidthLimit(frame, limit, splatted.clamped, kCutOff);
    limit.parameter = "maximum";
    limit.value = static_cast<double>(params.maximumPixels);
    limit.counted = "splats are smaller than they were to be";
    reportWidthLimit(frame, limit, splatted.clamped, kShrunk);
    return splatted.stored;
}

CausticMap splat(FrameBuilder& frame, const Splatting& splatting, const Hits& hits,
                 const Surfaces& surfaces, const CausticMap& before) {
    return storeEverywhere(frame, surfaces, hits, before,
                           [&](const Store& store, const Hits& own, const FluxMap& former) {
                               return splatInto(frame, splatting, own, store, former);
                           });
}

}  // namespace kaustik
