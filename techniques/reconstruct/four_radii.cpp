// SPDX-License-Identifier: MIT
// reconstruct.four_radii: photons as splats of four sizes at once, in a set of the map each,
// counted by texel (WD08, section 4.1; splats/texel_splats.h). filter.blend takes of them what each
// texel needs.
#include "techniques/splats/texel_splats.h"

namespace kaustik {
namespace {

struct FourRadiiParams {
    SplatEdges edges = SplatEdges::kept;
    template <class R>
    void reflect(R& r) {
        r.choice(edges, "edges", kEdgesSentence, {"kept", "crossed"});
    }
};

CausticMap splatFourRadii(FrameBuilder& frame, const FourRadiiParams& params, Hits hits,
                          Surfaces surfaces, CausticMap before) {
    TexelSplats splats{.node = "reconstruct.four_radii",
                       .reason = "photons are splats of four sizes, counted by texel"};
    splats.edges = params.edges;
    splats.layout = SetLayout::sizes;
    splats.counts = true;
    return splat(frame, splats, hits, surfaces, before);
}

}  // namespace

void registerReconstructFourRadii(Registry& registry) {
    registry.node<ReconstructStage>(
        "four_radii",
        {"Splats each photon in four sizes at once, 3, 7, 11 and 15 texels, and counts "
         "photons; filter.blend takes one or some of them.",
         "WD08, section 4.1",
         "It stores four maps, of which filter=blend makes one; a gather without it is refused. "
         "The four sizes are given."},
        {.filter = "blend"}, &splatFourRadii);
}

}  // namespace kaustik
