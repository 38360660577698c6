// SPDX-License-Identifier: MIT
#include "techniques/photon_lists/light_spread.h"

namespace kaustik {

Hits spreadByLights(FrameBuilder& frame, Hits emitted) {
    if (!emitted.incoming.hasBeams() || !frame.facts().widensByLights()) return emitted;
    struct Data {
        Photons photons;
    };
    emitted.incoming =
        frame
            .pass<Data>(
                "emit.light_spread", "lights that have a size spread what comes from their points",
                [&](graph::PassSetup& setup, Data& data) {
                    emitted.incoming.sample(setup);
                    data.photons = emitted.incoming;
                    data.photons.createSpread(setup);
                    setup.image("nextSpreadPlace", data.photons.spreadPlace);
                    setup.image("nextSpreadTurn", data.photons.spreadTurn);
                },
                [list = emitted.incoming](const Data&, gl::PassContext& context) {
                    gl::Command command = context.compute("emit/light_spread.comp");
                    dispatchOver(command, list);
                })
            .photons;
    return emitted;
}

}  // namespace kaustik
