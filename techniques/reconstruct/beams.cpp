// SPDX-License-Identifier: MIT
// reconstruct.beams: reconstruct.sprites with the ellipse that a photon's beam covers where it
// arrives, so that splats are as wide as light spreads and as narrow as it converges.
#include "techniques/splats/sprite_splats.h"

namespace kaustik {
namespace {

enum class BeamShape : int { ellipse, round };

struct BeamsParams {
    BeamShape shape = BeamShape::ellipse;
    SpriteKernel kernel = SpriteKernel::gaussian;
    float footprints = 1.8f;
    int maximumPixels = 100;
    int reachPixels = 120;
    template <class R>
    void reflect(R& r) {
        r.choice(shape, "shape",
                 "ellipse: what the beam covers of the receiver's plane; round: a disc of the same "
                 "area, the comparison",
                 {"ellipse", "round"});
        r.choice(kernel, "kernel",
                 "gaussian: cut off at 3 sigma; linear: K06's; epanechnikov: a parabola",
                 {"gaussian", "linear", "epanechnikov"});
        r.field(footprints, "footprints", "Radius of a splat in widths of its photon's beam", "",
                params::range(0.1f, 100.0f));
        r.field(maximumPixels, "maximum", "Largest radius on the screen; splats shrink to it", "px",
                params::range(1, 100));
        r.field(
            reachPixels, "reach",
            "Farthest from its middle that a splat goes on the screen; it is cut off there, and "
            "keeps its flux",
            "px", params::range(1, 127));
    }
};

CausticMap splatBeams(FrameBuilder& frame, const BeamsParams& params, Hits hits, Surfaces surfaces,
                      CausticMap before) {
    Splatting splatting{"reconstruct.beams", {}, true, false};
    splatting.areRound = params.shape == BeamShape::round;
    splatting.params.kernel = params.kernel;
    splatting.params.footprints = params.footprints;
    splatting.params.maximumPixels = params.maximumPixels;
    splatting.params.reachPixels = params.reachPixels;
    needsBeams(frame, splatting.node, hits.incoming);
    return splat(frame, splatting, hits, surfaces, before);
}

}  // namespace

void registerReconstructBeams(Registry& registry) {
    registry.node<ReconstructStage>(
        "beams",
        {"Splats each photon as the ellipse that its beam covers of the receiver after "
         "all of its interactions, integrated over the pixels.",
         "ray differentials: Igehy 1999; elliptical weighted averages: Heckbert 1989",
         "It needs photons with beams. A splat lies in the tangent plane of one receiver, its "
         "ellipse is the beam to first order, and it is no wider than the node's bounds allow, "
         "which the report says."},
        {.beams = true}, &splatBeams);
}

}  // namespace kaustik
