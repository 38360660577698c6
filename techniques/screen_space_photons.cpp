// SPDX-License-Identifier: MIT
#include "techniques/screen_space_photons/nodes.h"

namespace kaustik {

void registerScreenSpacePhotons(Registry& registry) {
    // The first of a stage is what a technique has that does not choose.
    registerLists(registry);
    registerPeel(registry);
    registerPeelObjects(registry);
    registerLines(registry);
    registerMarch(registry);
    registerAllHits(registry);
    registerShadowRays(registry);
    registerTriangles(registry);
    registerSprites(registry);
    registerGodRays(registry);
    registerGaussianBlur(registry);
    registerRefraction(registry);
    registerImageSpace(registry);
    registry.technique({"screen_space_photons",
                        "Photon rays traced on the screen through a layered depth image.",
                        "Krüger, Bürger, Westermann 2006",
                        {{"layers", "auto"},
                         {"trace", "hierarchical"},
                         {"reconstruct", "triangles"},
                         {"view", "refraction"}},
                        {}});
}

}  // namespace kaustik
