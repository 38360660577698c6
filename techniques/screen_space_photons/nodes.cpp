// SPDX-License-Identifier: MIT
#include "techniques/screen_space_photons/nodes.h"

namespace kaustik {

void registerScreenSpacePhotons(Registry& registry) {
    registry.node<LayersStage>("peel",
                               {"Depth peeling into a layered depth image, no deeper than the "
                                "picture's measured depth complexity.",
                                "K06, section 2.2"},
                               &peelLayers);
    registry.node<LayersStage>("per_object",
                               {"Peels every object by itself, no deeper than it is, and merges "
                                "them: less geometry where many objects overlap.",
                                "K06, section 2.2"},
                               &peelObjects);
    registry.node<TraceStage>("lines",
                              {"Rasterises each photon's ray as a line into a row of a texture and "
                               "reduces the row to its first hit.",
                               "K06, section 2.1"},
                              &traceLines);
    registry.node<TraceStage>("march",
                              {"Follows each photon's ray over the screen in a fragment shader, "
                               "a pixel a step, to its first hit.",
                               "K06, section 2.1, the comparison"},
                              &traceMarch);
    registry.node<TraceStage>(
        "march_compute",
        {"The same in a compute shader, one thread a photon.", "K06, section 2.1, the comparison"},
        &traceMarchCompute);
    registry.node<TraceStage>("hierarchical",
                              {"Follows each photon's ray in a fragment shader and leaves out "
                               "squares of pixels whose layers it cannot meet.",
                               ""},
                              &traceHierarchical);
    registry.node<TraceStage>("hierarchical_compute",
                              {"The same in a compute shader, one thread a photon.", ""},
                              &traceHierarchicalCompute);
    registry.node<TraceStage>("all_hits",
                              {"Lights every receiver on a photon's ray instead of the first: the "
                               "wrong picture, for comparison.",
                               "K06, section 2, Fig. 3"},
                              &traceAllHits);
    registry.node<ShadowStage>(
        "rays",
        {"Traces a ray from every receiver to the light through the layers.", "K06, section 5"},
        &traceShadowRays);
    registry.node<ReconstructStage>("sprites",
                                    {"Splats each photon as a disc in its receiver's tangent "
                                     "plane, ray-cast per pixel; the flux is kept exactly.",
                                     "K06, section 3.1, Eq. 1"},
                                    &splatSprites);
    registry.node<MediaStage>("lines",
                              {"Draws each photon's way through the medium as a line of the light "
                               "that is scattered towards the eye.",
                               "K06, section 3.2"},
                              &drawGodRays);
    registry.node<BlurStage>("gaussian",
                             {"Smooths in-scattered light with a Gaussian of constant size on the "
                              "screen.",
                              "K06, section 3.2"},
                             &blurGaussian);
    registry.node<ViewStage>("refraction",
                             {"Traces the eye's refracted rays on the screen through the layers of "
                              "the transmitting objects, and on into the scene.",
                              "K06, section 4"},
                             &traceRefraction);
    registry.node<ViewStage>("image_space",
                             {"Refracts the eye's rays at two interfaces, with the distance inside "
                              "estimated from the back faces.",
                              "Wyman 2005 (W05), K06's comparison"},
                             &refractInImageSpace);
    registry.technique({"screen_space_photons",
                        "Photon rays traced on the screen through a layered depth image.",
                        "Krüger, Bürger, Westermann 2006",
                        {{"layers", "peel"},
                         {"trace", "hierarchical"},
                         {"reconstruct", "sprites"},
                         {"view", "refraction"}},
                        {}});
}

}  // namespace kaustik
