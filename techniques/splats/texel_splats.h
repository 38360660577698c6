// SPDX-License-Identifier: MIT
// Photons as Gaussian splats of the texels of whatever they are stored in, a light's map or the
// screen (WD06, WD08). A point of OpenGL is a square, and so is their support; weights are summed
// over the texels that take them first, so that each size deposits the photon's flux exactly. In:
// hits, eye view space, m and W; out: flux a texel, W, in as many sets as there are sizes or
// levels.
#pragma once

#include <optional>
#include <string>

#include "techniques/stores/stores.h"

namespace kaustik {

// The texels that a splat lies on.
enum class SplatEdges : int { kept, crossed };
enum class SplatCenter : int { photon, texel };

constexpr const char* kEdgesSentence =
    "kept: texels that see the photon's own surface; crossed: all that it covers, as published, so "
    "that light leaks over edges";

// Diameters that follow the photons' beams, in widths of the beam; within these bounds, texels.
struct BeamDiameters {
    float widths = 3.5f;
    bool isRound = false;  // on the texels, whatever the receiver's slant; else on the receiver
    float minimum = 2.0f;
    float maximum = 96.0f;
};

struct TexelSplats {
    std::string node;
    std::string reason;
    SetLayout layout = SetLayout::one;
    bool counts = false;
    SplatEdges edges = SplatEdges::kept;
    SplatCenter center = SplatCenter::photon;
    float diameter = 7.0f;
    std::optional<BeamDiameters> beams = {};  // instead of `diameter`
};

[[nodiscard]] CausticMap splat(FrameBuilder& frame, const TexelSplats& splats, const Hits& hits,
                               const Surfaces& surfaces, const CausticMap& before);

}  // namespace kaustik
