// SPDX-License-Identifier: MIT
// reconstruct.lens: photons as Gaussians as wide as their beams are where they arrive (WD08,
// section 4.2, Eqs. 1 to 7; splats/texel_splats.h). The paper's are round on the texels; where the
// receiver is not seen along the beam, as on a wall, what a round beam covers of it is an ellipse
// there.
#include "techniques/splats/texel_splats.h"

namespace kaustik {
namespace {

// What a splat covers.
enum class LensShape : int { receiver, texels };

struct LensParams {
    LensShape shape = LensShape::receiver;
    float widths = 3.5f;
    float minDiameter = 2.0f;
    float maxDiameter = 96.0f;
    SplatEdges edges = SplatEdges::kept;
    template <class R>
    void reflect(R& r) {
        r.choice(
            shape, "shape",
            "receiver: what a round beam covers of its receiver, which texels that see it at a "
            "slant see as an ellipse; texels: as wide and as round on the texels as the beam is "
            "across, whatever the receiver's slant, as published",
            {"receiver", "texels"});
        r.field(widths, "widths",
                "Diameter of a splat in widths of its photon's beam, D0 of WD08's Eq. 7; more is "
                "less noise and more blur",
                "", params::range(0.1f, 100.0f));
        r.field(minDiameter, "min_diameter", "Smallest diameter", "texels",
                params::range(1.0f, 127.0f));
        r.renamed("least", "min_diameter");
        r.field(maxDiameter, "max_diameter", "Largest diameter; splats shrink to it", "texels",
                params::range(1.0f, 127.0f));
        r.renamed("most", "max_diameter");
        r.choice(edges, "edges", kEdgesSentence, {"kept", "crossed"});
    }
};

CausticMap splatLens(FrameBuilder& frame, const LensParams& params, Hits hits, Surfaces surfaces,
                     CausticMap before) {
    needsBeams(frame, "reconstruct.lens", hits.incoming);
    TexelSplats splats{.node = "reconstruct.lens",
                       .reason = "photons are splats as wide as their beams where they arrive"};
    splats.edges = params.edges;
    splats.beams = BeamDiameters{params.widths, params.shape == LensShape::texels,
                                 params.minDiameter, params.maxDiameter};
    return splat(frame, splats, hits, surfaces, before);
}

}  // namespace

void registerReconstructLens(Registry& registry) {
    registry.node<ReconstructStage>(
        "lens",
        {"Splats each photon as a Gaussian as wide as its beam is where it "
         "arrives (specular.two_interfaces.lens says how that is known).",
         "WD08, section 4.2, Eqs. 1 to 7",
         "It needs photons with beams, and takes them as round: light that a surface draws out to "
         "a line is spread over a disc. Diameters stay between its two bounds."},
        {.beams = true}, &splatLens);
}

}  // namespace kaustik
