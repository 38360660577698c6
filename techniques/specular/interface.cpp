// SPDX-License-Identifier: MIT
// specular.interface: reflects or refracts photons where they have hit a specular surface and
// writes them into the next list of the transfer map (K06, section 2.3). Follows the transmitted
// branch, the reflected one at mirrors and in total internal reflection; the flux of the branch not
// followed goes to the ledger as untraced. Exact unpolarised Fresnel; eye view space, m and W.
#include "techniques/shared/next_photons.h"
#include "techniques/shared/nodes.h"
#include "techniques/shared/specular.h"

namespace kaustik {

Photons interactAtInterface(FrameBuilder& frame, const params::NoParams&, Hits hits,
                            Surfaces /*surfaces*/) {
    const NextPhotons next = makeRoom(frame, hits, 1);
    return frame.pass<Photons>(
        "specular.interface", "photons hit specular surfaces",
        [&](graph::PassSetup& setup, Photons& data) {
            data = sendOn(setup, hits, next);
            data.paths.transmissionOnly = true;
        },
        [list = hits.incoming](const Photons&, gl::PassContext& context) {
            dispatchOver(context.compute("shared/specular_interface.comp"), list);
        });
}

void registerSpecularInterface(Registry& registry) {
    registry.node<SpecularStage>("interface",
                                 {"Refracts, or reflects totally or at a mirror; the other Fresnel "
                                  "branch goes to the ledger.",
                                  "K06, section 2.3"},
                                 &interactAtInterface);
}

}  // namespace kaustik
