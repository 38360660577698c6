// SPDX-License-Identifier: MIT
// reconstruct.sprites: oriented, ray-cast sprites (K06, section 3.1, Eq. 1). Each photon lights a
// disc in the tangent plane of its receiver, or what its beam cuts out of it, falling off to the
// edge. Its weights are first summed over the receivers that the pixels see, so that the flux
// deposited is the photon's flux. A compute thread a photon does one and then the other. In: hits
// (eye view space, W) and what the eye, or any other views, see; out: flux a pixel, W, and where a
// receiver is glossy radiant intensity towards the eye, W/sr: each splat by the BRDF at each pixel,
// with the pixel's normal and reflectance.
// reconstruct.beams: the same with the ellipse that a photon's beam covers where it arrives, so
// that splats are as wide as light spreads and as narrow as it converges.
#include <fmt/format.h>

#include <algorithm>

#include "framework/pipeline/frame_builder.h"
#include "techniques/screen_space_photons/nodes.h"
#include "techniques/screen_space_photons/sprites.h"
#include "techniques/shared/narrowed.h"

namespace kaustik {
namespace {

// Splats that a parameter has cut off, and those that one has made smaller.
using CutSplats = graph::Buffer<transport::Narrowed>;
constexpr std::size_t kCutOff = 0;
constexpr std::size_t kShrunk = 1;

// Of a cube a splat may touch three faces, and Mesa's software rasteriser ends all loops of a
// thread after 65,535 turns together.
constexpr int kMostReachOnCubes = 72;

CausticMap splat(FrameBuilder& frame, const Splatting& splatting, const Hits& hits,
                 const Surfaces& surfaces, const CausticMap& before) {
    return storeEverywhere(frame, surfaces, hits, before,
                           [&](const Store& store, const Hits& own, const FluxMap& former) {
                               return splatInto(frame, splatting, own, store, former);
                           });
}

CausticMap splatSprites(FrameBuilder& frame, const SpritesParams& params, Hits hits,
                        Surfaces surfaces, CausticMap before) {
    return splat(frame, {"reconstruct.sprites", params, false, false}, hits, surfaces, before);
}

enum class BeamShape : int { ellipse, round };

struct BeamsParams {
    BeamShape shape = BeamShape::ellipse;
    SpriteKernel kernel = SpriteKernel::gaussian;
    float footprints = 1.8f;
    int maximumPixels = 100;
    int reachPixels = 120;
    template <class R>
    void reflect(R& r) {
        r.choice(shape, "shape",
                 "ellipse: what the beam covers of the receiver's plane; round: a disc of the same "
                 "area, the comparison",
                 {"ellipse", "round"});
        r.choice(kernel, "kernel",
                 "gaussian: cut off at 3 sigma; linear: K06's; epanechnikov: a parabola",
                 {"gaussian", "linear", "epanechnikov"});
        r.field(footprints, "footprints", "Radius of a splat in widths of its photon's beam", "",
                params::range(0.1f, 100.0f));
        r.field(maximumPixels, "maximum", "Largest radius on the screen; splats shrink to it", "px",
                params::range(1, 100));
        r.field(
            reachPixels, "reach",
            "Farthest from its middle that a splat goes on the screen; it is cut off there, and "
            "keeps its flux",
            "px", params::range(1, 127));
    }
};

CausticMap splatBeams(FrameBuilder& frame, const BeamsParams& params, Hits hits, Surfaces surfaces,
                      CausticMap before) {
    Splatting splatting{"reconstruct.beams", {}, true, false};
    splatting.areRound = params.shape == BeamShape::round;
    splatting.params.kernel = params.kernel;
    splatting.params.footprints = params.footprints;
    splatting.params.maximumPixels = params.maximumPixels;
    splatting.params.reachPixels = params.reachPixels;
    needsBeams(frame, splatting.node, hits.incoming);
    return splat(frame, splatting, hits, surfaces, before);
}

}  // namespace

Stored splatInto(FrameBuilder& frame, const Splatting& splatting, const Hits& hits,
                 const Store& store, const FluxMap& before) {
    const SpritesParams& params = splatting.params;
    const ReceiverView& receivers = store.receivers;
    const FluxSets sets = setsIn(frame, store);
    const bool isGlossy = sets.hasIntensity;
    const int reach = receivers.views->count() == 1
                          ? params.reachPixels
                          : std::min(params.reachPixels, kMostReachOnCubes);
    struct Data {
        CutSplats cut;
        Stored stored;
    };
    const Data& splatted = frame.pass<Data>(
        splatting.node,
        isGlossy ? "photons deposit flux at the receivers, and, since some are glossy, how it "
                   "goes to the eye"
                 : "photons deposit flux at the receivers",
        [&](graph::PassSetup& setup, Data& data) {
            data.stored = depositIn(setup, store, hits, before, sets);
            data.cut = setup.storage("CutSplats",
                                     setup.createBuffer<transport::Narrowed>(
                                         "splats.cut" + store.suffix + hits.incoming.suffix, 2));
            setup.bypass(data.cut, {0, 0, 0, 0});
            setup.bypass(setup.storage("SplatTotals",
                                       setup.createBuffer<float>(
                                           "splats.totals" + store.suffix + hits.incoming.suffix,
                                           static_cast<std::size_t>(hits.incoming.capacity()))),
                         {0, 0, 0, 0});
        },
        [splatting, reach, sets, store, list = hits.incoming](const Data& data,
                                                              gl::PassContext& context) {
            if (!context.isRepeated()) context.buffer(data.cut).clear();
            clearIfFirst(context, data.stored);
            for (const char* shader : {"sprite_totals", "sprites"}) {
                gl::Command command =
                    context.compute(fmt::format("screen_space_photons/{}.comp", shader));
                bindStore(command, store).params("reconstruct.sprites", splatting.params);
                command.set("mostReach", reach);
                if (splatting.areBeams)
                    command.define("BEAM_SPLATS").set("isRound", splatting.areRound ? 1 : 0);
                if (shader == std::string("sprites")) setDeposit(command, sets);
                dispatchOver(command, list);
            }
        });
    keepToWidth(frame, splatting.node, splatted.cut, kCutOff, "reach", reach, "splats are cut off");
    keepToWidth(frame, splatting.node, splatted.cut, kShrunk, "maximum", params.maximumPixels,
                "splats are smaller than they were to be");
    return splatted.stored;
}

void registerSprites(Registry& registry) {
    registry.node<ReconstructStage>("sprites",
                                    {"Splats each photon as a disc in its receiver's tangent "
                                     "plane, ray-cast per pixel; the flux is kept exactly.",
                                     "K06, section 3.1, Eq. 1"},
                                    &splatSprites);
    registry.node<ReconstructStage>(
        "beams",
        {.sentence = "Splats each photon as the ellipse that its beam covers of the receiver after "
                     "all of its interactions, integrated over the pixels.",
         .source = "ray differentials: Igehy 1999; elliptical weighted averages: Heckbert 1989",
         .beams = true},
        &splatBeams);
}

}  // namespace kaustik
