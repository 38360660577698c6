// SPDX-License-Identifier: MIT
// reconstruct.multi_level: photons as splats in that level of the map's resolution whose texels are
// as wide as their beams (WN09, section 3.2.2; splats/texel_splats.h). filter.level_sum adds up all
// levels.
#include <string>

#include "techniques/splats/texel_splats.h"

namespace kaustik {
namespace {

struct MultiLevelParams {
    int diameter = 3;
    SplatEdges edges = SplatEdges::kept;
    template <class R>
    void reflect(R& r) {
        r.field(diameter, "diameter", "Of a splat, in texels of its photon's level; 1: points",
                "texels", params::range(1, 15));
        r.choice(edges, "edges",
                 std::string("At the finest level; coarser ones see none. ") + kEdgesSentence,
                 {"kept", "crossed"});
    }
};

CausticMap splatOneLevel(FrameBuilder& frame, const MultiLevelParams& params, Hits hits,
                         Surfaces surfaces, CausticMap before) {
    needsBeams(frame, "reconstruct.multi_level", hits.incoming);
    TexelSplats splats{.node = "reconstruct.multi_level",
                       .reason = "photons whose light spreads are splats in coarser levels"};
    splats.diameter = static_cast<float>(params.diameter);
    splats.edges = params.edges;
    splats.layout = SetLayout::sharedLevels;
    return splat(frame, splats, hits, surfaces, before);
}

}  // namespace

void registerReconstructMultiLevel(Registry& registry) {
    registry.node<ReconstructStage>(
        "multi_level",
        {"Splats each photon into that level of the map's resolution whose texels are "
         "as wide as its beam where it arrives; filter.level_sum adds up all of them.",
         "WN09, section 3.2.2, multi-resolution caustic map",
         "Coarser levels see no edges: light leaks over them there. Its levels are added by "
         "filter=level_sum; a gather without it is refused."},
        {.beams = true, .filter = "level_sum"}, &splatOneLevel);
}

}  // namespace kaustik
