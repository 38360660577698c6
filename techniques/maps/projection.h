// SPDX-License-Identifier: MIT
// Maps of flux looked up at the eye's receivers, like shadow maps.
#pragma once

#include <string>

#include "framework/pipeline/frame_builder.h"

namespace kaustik {

struct Projection {
    std::string node;  // for pass and messages
    std::string reason;
    int maxSamples = 4;         // most looks along each side of a pixel
    bool isFromCentre = false;  // where a receiver is glossy: light comes from where the map is
                                // seen from; else from the mean direction of a texel's
};
// In: maps of which FluxMap::isOne() holds; out: the sum of all, irradiance in W/m² and, where a
// receiver is glossy, radiance in W/m²/sr.
[[nodiscard]] IrradianceMap projectMaps(FrameBuilder& frame, const Projection& projection,
                                        CausticMap map, const Surfaces& surfaces);

}  // namespace kaustik
