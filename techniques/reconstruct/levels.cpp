// SPDX-License-Identifier: MIT
// reconstruct.levels: photons as splats in every level of the map's resolution, counted by texel
// (WD08, section 4, Fig. 4; splats/texel_splats.h). filter.levels takes one.
#include "techniques/splats/texel_splats.h"

namespace kaustik {
namespace {

struct LevelsParams {
    int diameter = 3;
    template <class R>
    void reflect(R& r) {
        r.field(diameter, "diameter",
                "Of a splat in every level, in that level's texels; 1: points", "texels",
                params::range(1, 15));
    }
};

CausticMap splatLevels(FrameBuilder& frame, const LevelsParams& params, Hits hits,
                       Surfaces surfaces, CausticMap before) {
    TexelSplats splats{.node = "reconstruct.levels",
                       .reason = "photons are splats in every level of the map"};
    // Coarser levels' texels hold several surfaces, and cross edges all the same.
    splats.diameter = static_cast<float>(params.diameter);
    splats.layout = SetLayout::levels;
    splats.counts = true;
    return splat(frame, splats, hits, surfaces, before);
}

}  // namespace

void registerReconstructLevels(Registry& registry) {
    registry.node<ReconstructStage>(
        "levels",
        {"Splats each photon into every level of the map's resolution; filter.levels "
         "takes one.",
         "WD08, section 4, Fig. 4; rejected there",
         "It stores every level, of which filter=levels makes one; a gather without it is refused. "
         "WD08 rejects it."},
        {.filter = "levels"}, &splatLevels);
}

}  // namespace kaustik
