// SPDX-License-Identifier: MIT
// specular.interface: reflects or refracts photons where they have met a specular surface and
// writes them back into the transfer map (K06, section 2.3). Follows the transmitted branch, the
// reflected one at mirrors and in total internal reflection; the flux of the branch not followed
// goes to the ledger as untraced. Exact unpolarised Fresnel; eye view space, m and W.
#include "framework/pipeline/frame_builder.h"
#include "techniques/shared/nodes.h"

namespace kaustik {

Hits interactAtInterface(FrameBuilder& frame, const params::NoParams&, Hits hits) {
    struct Data {
        Hits hits;
        Photons photons;
    };
    const bool isFirst = frame.runsOf(SpecularStage::name) == 1;
    hits.incoming =
        frame
            .pass<Data>(
                "specular.interface", "photons meet specular surfaces",
                [&](graph::PassSetup& setup, Data& data) {
                    data.hits = hits;
                    setup.read(hits.position);
                    setup.read(hits.surface);
                    setup.read(hits.flux);
                    data.photons = hits.incoming;
                    data.photons.position = setup.write(hits.incoming.position);
                    data.photons.direction = setup.write(hits.incoming.direction);
                    data.photons.flux = setup.write(hits.incoming.flux);
                    data.photons.ledger = setup.write(hits.incoming.ledger);
                    data.photons.paths.transmissionOnly = true;
                    ++data.photons.paths.interactions;
                },
                [&inputs = frame.inputs(), isFirst](const Data& data, gl::PassContext& context) {
                    gl::Command command = context.compute("shared/specular_interface.comp");
                    inputs.bindLedger(command, data.photons.ledger)
                        .storage("Materials", inputs.gpuScene.materials())
                        .image("photonPosition", data.photons.position)
                        .image("photonDirection", data.photons.direction)
                        .image("photonFlux", data.photons.flux)
                        .texture("hitPosition", data.hits.position)
                        .texture("hitSurface", data.hits.surface)
                        .texture("hitFlux", data.hits.flux)
                        .set("isFirst", isFirst ? 1 : 0)
                        .dispatchOver(data.photons.width, 8, data.photons.height, 8);
                })
            .photons;
    return hits;
}

}  // namespace kaustik
