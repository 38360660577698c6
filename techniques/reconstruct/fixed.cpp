// SPDX-License-Identifier: MIT
// reconstruct.fixed: photons as Gaussian splats of one size, in texels of whatever they are stored
// in (WD06; WD08, section 3; splats/texel_splats.h).
#include "techniques/splats/texel_splats.h"

namespace kaustik {
namespace {

struct FixedParams {
    int diameter = 7;
    SplatEdges edges = SplatEdges::kept;
    SplatCenter center = SplatCenter::photon;
    template <class R>
    void reflect(R& r) {
        r.field(diameter, "diameter", "Of a splat; 1: points, for filter.blur", "texels",
                params::range(1, 63));
        r.choice(edges, "edges", kEdgesSentence, {"kept", "crossed"});
        r.choice(center, "center", "photon: where it arrives; texel: the middle of its texel",
                 {"photon", "texel"})
            .when(diameter > 1, "with reconstruct.fixed.diameter=1");
    }
};

CausticMap splatFixed(FrameBuilder& frame, const FixedParams& params, Hits hits, Surfaces surfaces,
                      CausticMap before) {
    TexelSplats splats{.node = "reconstruct.fixed", .reason = "photons are splats of one size"};
    splats.edges = params.edges;
    splats.center = params.center;
    splats.diameter = static_cast<float>(params.diameter);
    return splat(frame, splats, hits, surfaces, before);
}

}  // namespace

void registerReconstructFixed(Registry& registry) {
    registry.node<ReconstructStage>(
        "fixed",
        {"Splats each photon as a Gaussian of so many texels.", "WD06; WD08, section 3",
         "One size for all photons: where they are few there are gaps, where light converges it is "
         "blurred. With edges=crossed light leaks over the edges of surfaces."},
        &splatFixed);
}

}  // namespace kaustik
