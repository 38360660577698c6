// SPDX-License-Identifier: MIT
// gather.screen: a map of flux that was stored by the eye's own pixels becomes irradiance over the
// area of the receiver that each sees. In: flux, W (W/sr towards the eye); out: W/m² (W/m²/sr).
#include "framework/pipeline/frame_builder.h"
#include "techniques/maps/directions.h"
#include "techniques/maps/map_needs.h"

namespace kaustik {
namespace {

IrradianceMap gatherOnScreen(FrameBuilder& frame, const params::NoParams&, CausticMap map,
                             Surfaces surfaces) {
    needsMap("gather.screen", map, {SetLayout::one, StoreSpace::screen});
    const FluxMap& stored = map.maps.front();
    struct Data {
        IrradianceMap gathered;
        CountedPixels tooLong;
    };
    const Data& data = frame.pass<Data>(
        "gather.screen", "what was deposited is spread over what each pixel sees",
        [&](graph::PassSetup& setup, Data& made) {
            if (stored.filtered.valid()) {
                setup.sample("filteredFlux", stored.filtered);
                setup.define("IS_FILTERED");
            } else {
                setup.sample("fluxSums", stored.flux);
            }
            setup.sample("receiver", surfaces.eye.receiver);
            IrradianceMap& gathered = made.gathered;
            gathered.ledger = map.ledger;
            gathered.irradiance =
                setup.create<IrradianceTexel>("caustic.irradiance", frame.width(), frame.height());
            setup.bypass(gathered.irradiance, {0, 0, 0, 0});
            if (!stored.sets.isGlossy()) return;
            gathered.radiance =
                setup.create<RadianceTexel>("caustic.radiance", frame.width(), frame.height());
            setup.bypass(gathered.radiance, {0, 0, 0, 0});
            if (!stored.sets.hasDirection()) return;
            setup.sample("receiverSurface", surfaces.eye.receiverSurface);
            setup.sample("receiverAlbedo", surfaces.eye.receiverAlbedo);
            made.tooLong = countLongDirections(setup, "");
        },
        [sets = stored.sets](const Data& made, gl::PassContext& context) {
            gl::Command command = context.fullscreen("gather/screen.frag");
            command.target(made.gathered.irradiance);
            if (sets.isGlossy()) command.target(made.gathered.radiance);
            if (sets.hasIntensity()) command.define("HAS_INTENSITY");
            if (sets.hasDirection()) {
                command.define("HAS_DIRECTION");
                made.tooLong.clear(context);
            }
            command.draw();
        });
    if (stored.sets.hasDirection()) warnOfDirections(frame, "gather.screen", data.tooLong);
    return data.gathered;
}

}  // namespace

void registerGatherScreen(Registry& registry) {
    registry.node<GatherStage>(
        "screen",
        {"Flux that was stored by the eye's pixels, over what they see.", "K06, section 3.1",
         "It takes light that is stored by the eye's pixels and refuses maps of lights and cubes. "
         "Nothing off the screen can be looked up."},
        &gatherOnScreen);
}

}  // namespace kaustik
