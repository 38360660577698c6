// SPDX-License-Identifier: MIT
// specular.interface: reflects or refracts photons where they have hit a specular surface and
// writes them into the next list of the transfer map (K06, section 2.3). Follows the transmitted
// branch, the reflected one at mirrors and in total internal reflection; the flux of the branch not
// followed goes to the ledger as untraced. Exact unpolarised Fresnel; eye view space, m and W.
#include "techniques/specular/interface.h"
#include "techniques/photon_lists/next_photons.h"

namespace kaustik {

Photons interactAtInterface(FrameBuilder& frame, const params::NoParams&, Hits hits,
                            Surfaces /*surfaces*/) {
    const NextPhotons next = allocateNext(frame, hits);
    return frame.pass<Photons>(
        "specular.interface", "photons hit specular surfaces",
        [&](graph::PassSetup& setup, Photons& data) {
            data = bindNextPhotons(setup, hits, next);
            data.paths.transmissionOnly = true;
        },
        [list = hits.incoming](const Photons&, gl::PassContext& context) {
            dispatchOver(context.compute("specular/interface.comp"), list);
        });
}

void registerSpecularInterface(Registry& registry) {
    registry.node<SpecularStage>(
        "interface",
        {"Refracts, or reflects totally or at a mirror; the other Fresnel "
         "branch goes to the ledger.",
         "K06, section 2.3",
         "One Fresnel branch is followed, the refracted one wherever there is one; the flux of the "
         "other is lost, and booked as untraced_branch. It makes one interaction at a time: the "
         "next interface is for the tracer to find."},
        &interactAtInterface);
}

}  // namespace kaustik
