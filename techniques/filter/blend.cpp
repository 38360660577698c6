// SPDX-License-Identifier: MIT
// filter.blend: of splats of four sizes, each texel takes those that enough photons lie on (WD08,
// section 4.1). In: the sets of reconstruct.four_radii, with counts; out: flux a texel, W. It does
// not keep the flux, which the report's blend_energy_ratio says.
#include <utility>

#include "techniques/maps/map_filters.h"
#include "techniques/maps/map_needs.h"

namespace kaustik {
namespace {

enum class Interpolant : int { bernstein, nested, linear };

struct BlendParams {
    Interpolant interpolant = Interpolant::bernstein;
    int minPhotons = 8;
    int maxPhotons = 16;
    template <class R>
    void reflect(R& r) {
        r.choice(
            interpolant, "interpolant",
            "bernstein: up to three sizes, smaller ones where they are brighter, with weights that "
            "are divided by their sum: the size that has enough keeps 1 of it, so that a smaller "
            "one jumps from a half to all at max_photons; nested: the same weights, by each of "
            "which a size takes over from what the larger ones give, so that nothing jumps; "
            "linear: two, which rings",
            {"bernstein", "nested", "linear"});
        r.field(minPhotons, "min_photons",
                "Photons on a texel up to which a size of splat is not used", "",
                params::range(0, 1000000));
        r.renamed("least", "min_photons");
        r.field(maxPhotons, "max_photons",
                "Photons on a texel from which on a size of splat is enough", "",
                params::range(1, 1000000));
        r.renamed("most", "max_photons");
    }
};

CausticMap blendSizes(FrameBuilder& frame, const BlendParams& params, CausticMap map) {
    needsMap("filter.blend", map, {SetLayout::sizes});
    return filterMaps(
        frame, "filter.blend", "each texel takes the splats that its photons are dense enough for",
        std::move(map),
        [](graph::PassSetup& setup, Filtered& data) {
            setup.sample("photonCounts", data.map.counts);
        },
        [params](const Filtered& data, gl::PassContext& context) {
            gl::Command command = filterCommand(context, "filter/blend.comp", data.map);
            command.params("filter.blend", params);
            dispatchOverMap(command, data.map);
        });
}

}  // namespace

void registerFilterBlend(Registry& registry) {
    registry.node<FilterStage>(
        "blend",
        {"Takes of four sizes of splats those that enough photons lie on.", "WD08, section 4.1",
         "It takes the maps of reconstruct=four_radii and refuses others. It does not keep the "
         "flux, which map.blend_energy_ratio of the report states. A size that is darker than the "
         "larger ones has no part until it has enough photons, and then has all."},
        &blendSizes);
}

}  // namespace kaustik
