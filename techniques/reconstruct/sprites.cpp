// SPDX-License-Identifier: MIT
// reconstruct.sprites: oriented, ray-cast sprites (K06, section 3.1, Eq. 1). Each photon lights a
// disc in the tangent plane of its receiver, or what its beam cuts out of it, falling off to the
// edge. Its weights are first summed over the receivers that the pixels see, so that the flux
// deposited is the photon's flux. A compute thread a photon does one and then the other. In: hits
// (eye view space, W) and what the eye, or any other views, see; out: flux a pixel, W, and where a
// receiver is glossy radiant intensity towards the eye, W/sr: each splat by the BRDF at each pixel,
// with the pixel's normal and reflectance.
#include "techniques/splats/sprite_splats.h"

namespace kaustik {
namespace {

CausticMap splatSprites(FrameBuilder& frame, const SpritesParams& params, Hits hits,
                        Surfaces surfaces, CausticMap before) {
    return splat(frame, {"reconstruct.sprites", params, false, false}, hits, surfaces, before);
}

}  // namespace

void registerReconstructSprites(Registry& registry) {
    registry.node<ReconstructStage>(
        "sprites",
        {"Splats each photon as a disc in its receiver's tangent "
         "plane, ray-cast per pixel; the flux is kept exactly.",
         "K06, section 3.1, Eq. 1",
         "A splat is as wide as the beam at its emission: too small where light spreads, too large "
         "where it converges. It lies in the tangent plane of one receiver, and is no wider than "
         "the node's bounds allow, which the report says."},
        &splatSprites);
}

}  // namespace kaustik
