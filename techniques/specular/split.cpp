// SPDX-License-Identifier: MIT
// specular.split: reflects and refracts photons where they have hit a specular surface and follows
// both Fresnel branches (K06, section 2.3), until one emitted photon has become 2^levels: its room
// is shared out among branches as the light is (include/photons/branches.glsl), so that weak ones
// are not followed into ever weaker ones, and neighbours take the same paths. A photon without room
// for two follows the stronger branch; the other's flux is in the ledger, as untraced_branch. Exact
// unpolarised Fresnel; eye view space, m and W.
#include "techniques/specular/split.h"

#include "techniques/photon_lists/next_photons.h"

namespace kaustik {

Photons splitAtInterface(FrameBuilder& frame, const SplitParams& params, Hits hits,
                         Surfaces /*surfaces*/) {
    const NextPhotons next = allocateNext(frame, hits, params.levels);
    return frame.pass<Photons>(
        "specular.split",
        params.levels > 0 ? "photons hit specular surfaces and follow both branches"
                          : "photons hit specular surfaces and follow the stronger branch",
        [&](graph::PassSetup& setup, Photons& data) { data = bindNextPhotons(setup, hits, next); },
        [levels = params.levels, list = hits.incoming](const Photons&, gl::PassContext& context) {
            gl::Command command = context.compute("specular/split.comp");
            if (levels > 0) command.set("branchesOfAll", 1u << static_cast<unsigned>(levels));
            dispatchOver(command, list);
        });
}

void registerSpecularSplit(Registry& registry) {
    registry.node<SpecularStage>(
        "split",
        {"Refracts and reflects: follows both Fresnel branches.", "K06, section 2.3",
         "An emitted photon becomes no more than 2^specular.split.levels: by then each follows the "
         "stronger branch alone, and what the weaker ones had is booked as untraced_branch."},
        &splitAtInterface);
}

}  // namespace kaustik
