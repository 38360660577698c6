// SPDX-License-Identifier: MIT
#include "techniques/caustic_map/nodes.h"

namespace kaustik {

void registerCausticMap(Registry& registry) {
    registerTwoInterfaces(registry);
    registerBackground(registry);
    registerTexelSplats(registry);
    registerMapFilters(registry);
    registerProject(registry);
    // What all of them share; WD06 and WD08 take 512 to 2048 photons a side and maps of 512 texels.
    const std::vector<std::pair<std::string, std::string>> inLightSpace{
        {"specular", "two_interfaces"}, {"trace", "background"}, {"reconstruct.space", "light"},
        {"gather", "project"},          {"view", "image_space"}, {"emit.photons", "512x512"}};
    const auto with = [&](std::vector<std::pair<std::string, std::string>> more) {
        more.insert(more.begin(), inLightSpace.begin(), inLightSpace.end());
        return more;
    };
    registry.technique({"caustic_map",
                        "Photons as Gaussian splats of one size in each light's map, which is "
                        "projected onto the scene.",
                        "Wyman, Davis 2006 (WD06)",
                        with({{"reconstruct", "fixed"}}),
                        {}});
    registry.technique({"vertex_caustics",
                        "The same with one photon a vertex of the specular objects.",
                        "Shah, Konttinen, Pattanaik (SP05)",
                        with({{"emit", "vertices"},
                              {"trace.background.step", "distance"},
                              {"reconstruct", "fixed"}}),
                        {}});
    registry.technique({"multi_resolution",
                        "Splats of four sizes at once, of which each texel takes what its photons "
                        "are dense enough for.",
                        "Wyman, Dachsbacher 2008 (WD08), section 4.1",
                        with({{"reconstruct", "four_radii"}, {"filter", "blend"}}),
                        {}});
    registry.technique({"lens_splats",
                        "Splats as wide as a thin lens of the refractor's curvatures makes each "
                        "photon's beam.",
                        "Wyman, Dachsbacher 2008 (WD08), section 4.2",
                        with({{"specular.two_interfaces.lens", "thin"}, {"reconstruct", "lens"}}),
                        {}});
    registry.technique({"eye_gather",
                        "The same splats straight on the screen, without a map.",
                        "Wyman, Dachsbacher 2008 (WD08), section 3",
                        with({{"specular.two_interfaces.lens", "thin"},
                              {"reconstruct", "lens"},
                              {"reconstruct.space", "screen"},
                              {"gather", "screen"}}),
                        {}});
}

}  // namespace kaustik
