// SPDX-License-Identifier: MIT
#include "techniques/shared/nodes.h"

namespace kaustik {

void registerSharedNodes(Registry& registry) {
    // In the order in which buildFrame() asks for them.
    registry.stage<GeometryStage>();
    registry.stage<EyeStage>();
    registry.stage<LayersStage>();
    registry.stage<ShadowStage>();
    registry.stage<EmitStage>();
    registry.stage<SpecularStage>();
    registry.stage<TraceStage>();
    registry.stage<ReconstructStage>();
    registry.stage<MediaStage>();
    registry.stage<BlurStage>();
    registry.stage<GatherStage>();
    registry.stage<ViewStage>();
    registry.stage<ComposeStage>();

    registry.sharedParams<LayersStage, LayersParams>();
    registry.sharedParams<EmitStage, EmitParams>();
    registry.sharedParams<SpecularStage, SpecularParams>();
    registry.sharedParams<TraceStage, TraceParams>();

    registry.node<GeometryStage>(
        "height_field", {"Makes the vertices of wavy water on the GPU.", ""}, &makeHeightFields);
    registry.node<EyeStage>("surfaces",
                            {"Rasterises the first receiver and the first specular surface of "
                             "every pixel.",
                             ""},
                            &renderEye);
    registry.node<EmitStage>("grid",
                             {"Rasterises the specular surfaces from each light, one photon a "
                              "texel.",
                              "K06, section 1.1"},
                             &emitGrid);
    registry.node<SpecularStage>("auto",
                                 {"Follows both Fresnel branches where water or a pane reflects "
                                  "much light to a receiver, else the refracted one.",
                                  ""},
                                 &interactAsNeeded);
    registry.node<SpecularStage>("interface",
                                 {"Refracts, or reflects totally or at a mirror; the other Fresnel "
                                  "branch goes to the ledger.",
                                  "K06, section 2.3"},
                                 &interactAtInterface);
    registry.node<ShadowStage>(
        "map", {"Draws the scene from each light and compares distances.", ""}, &lookUpShadowMaps);
    registry.node<SpecularStage>(
        "split", {"Refracts and reflects: follows both Fresnel branches.", "K06, section 2.3"},
        &splitAtInterface);
    registry.node<GatherStage>("screen",
                               {"Flux that was stored by the eye's pixels, over what they see.",
                                "Krüger et al. 2006, section 3.1"},
                               &gatherOnScreen);
    registry.node<BlurStage>("none", {"Leaves in-scattered light as it is.", ""}, &leaveUnblurred);
    registry.node<ViewStage>("interface",
                             {"Looks through the first specular surface with one refraction, at "
                              "the distance of the receiver straight behind it.",
                              ""},
                             &viewThroughInterface);
    registry.node<ComposeStage>("picture",
                                {"Direct light with its shadows, the caustic, and what the eye "
                                 "sees through specular surfaces.",
                                 ""},
                                &composePicture);
}

void registerMediaLeftOut(Registry& registry) {
    registry.node<MediaStage>("none", {"Leaves in-scattered light out.", ""}, &leaveOutScattering);
}

}  // namespace kaustik
