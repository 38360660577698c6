// SPDX-License-Identifier: MIT
// gather.screen: a map of flux that was stored by the eye's own pixels becomes irradiance over the
// area of the receiver that each sees. In: flux, W (W/sr towards the eye); out: W/m² (W/m²/sr).
#include <fmt/format.h>

#include "framework/core/error.h"
#include "framework/pipeline/frame_builder.h"

namespace kaustik {
namespace {

IrradianceMap gatherOnScreen(FrameBuilder& frame, const params::NoParams&, CausticMap map,
                             Surfaces surfaces) {
    const FluxMap& stored = map.maps.front();
    if (!stored.on.views->isEyeView())
        throw ConfigError(
            fmt::format("gather.screen works on the screen, but the map of flux it is given is "
                        "{}; take gather={}, or reconstruct.space=screen.",
                        render::describe(stored.on.views->space()),
                        stored.generator >= 0 ? "cube" : "project"));
    if (stored.sets.flux > 1 && !stored.filtered.valid())
        throw ConfigError(
            "gather.screen takes one map, but the light is stored in several sizes or "
            "levels; take filter=blend or filter=levels.");
    return frame.pass<IrradianceMap>(
        "gather.screen", "what was deposited is spread over what each pixel sees",
        [&](graph::PassSetup& setup, IrradianceMap& data) {
            if (stored.filtered.valid()) {
                setup.sample("filteredFlux", stored.filtered);
                setup.define("IS_FILTERED");
            } else {
                setup.sample("fluxSums", stored.flux);
            }
            setup.sample("receiver", surfaces.eye.receiver);
            data.ledger = map.ledger;
            data.irradiance =
                setup.create<IrradianceTexel>("caustic.irradiance", frame.width(), frame.height());
            setup.bypass(data.irradiance, {0, 0, 0, 0});
            if (!stored.sets.hasIntensity) return;
            data.radiance =
                setup.create<RadianceTexel>("caustic.radiance", frame.width(), frame.height());
            setup.bypass(data.radiance, {0, 0, 0, 0});
        },
        [](const IrradianceMap& data, gl::PassContext& context) {
            gl::Command command = context.fullscreen("gather/screen.frag");
            command.target(data.irradiance);
            if (data.radiance.valid()) command.define("HAS_INTENSITY").target(data.radiance);
            command.draw();
        });
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
