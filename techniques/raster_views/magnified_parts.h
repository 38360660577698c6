// SPDX-License-Identifier: MIT
// Which parts of a light's map the eye sees magnified, measured at the receivers that it sees: an
// adaptive subdivision of the map, the future work of WN09, section 6. Parts are squares of the
// light's view, found among those of a quadtree of it; each becomes a map of its own.
#pragma once

#include <vector>

#include "framework/render/view.h"

namespace kaustik {

// A place of a receiver that the eye sees.
struct SeenPlace {
    glm::dvec3 place{0.0};           // world space, m
    glm::dvec3 normal{0.0};          // unit, towards the eye
    double pixelSquareMeters = 0.0;  // that a pixel covers of the receiver there
    double step = 1.0;               // pixels from one such place to the next
};
// On a coarse grid of pixels. What mirrors hide is not seen, dielectrics hide nothing.
[[nodiscard]] std::vector<SeenPlace> seenPlaces(const scene::Scene& scene,
                                                const render::RasterView& eye);

// The side of the square that a texel of a view covers on the screen, pixels; 0 where the view does
// not see the place, or not the side of it that the eye sees. `border`: that much of the view along
// each side, as a share of its width, does not count.
[[nodiscard]] double pixelsPerTexel(const SeenPlace& seen, const render::RasterView& view,
                                    double border = 0.0);

struct MagnifiedParts {
    std::vector<render::RasterView> views;  // coarsest first; of as many pixels as `side` says
    // Pixels along a side of a texel of the map, and of the finest that holds a place: the median
    // of all places that the light's map sees, and what 95 % have less than.
    glm::dvec2 before{0.0};
    glm::dvec2 after{0.0};
};
// No more than `count` parts of a light's map, one view or six faces, that make magnified texels
// smaller; fewer where another would help less than a fiftieth of an octave on the mean.
[[nodiscard]] MagnifiedParts magnifiedParts(const std::vector<SeenPlace>& places,
                                            const std::vector<render::RasterView>& map, int side,
                                            int count);

}  // namespace kaustik
