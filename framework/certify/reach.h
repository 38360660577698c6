// SPDX-License-Identifier: MIT
// Where light that is known only by boxes of its places and directions may be seen.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/certify/eye_view.h"
#include "framework/certify/geometry.h"

namespace kaustik::certify {

// The pixels in which a facet is seen where rays from a box, in directions of a box, may meet it.
[[nodiscard]] EyeView::Extent pixelsReached(const Geometry& geometry, const EyeView& eye,
                                            const Vec& start, const Vec& along,
                                            std::uint32_t facet);

// Directions in which light of such directions may leave a surface that has a normal of the box, on
// the light's side: reflected, and unless it is a mirror refracted. `eta`: the index before over
// that behind.
void addDirections(const Vec& along, const Vec& normal, const Interval& eta, bool isMirror,
                   std::vector<Vec>& directions);

struct Reached {
    struct Part {
        std::uint32_t facet = 0;
        EyeView::Extent extent;  // in these of its pixels
    };
    bool isAnywhere = false;  // nothing is known
    std::vector<Part> parts;  // else it lies in these, or is unseen
    bool isLimited = false;   // some of it may meet more surfaces than it is followed to
};
// Where light from a box on facet `from` may be seen that goes in directions of the box, with so
// many more interactions at most.
void follow(const Geometry& geometry, const EyeView& eye, const Vec& start, const Vec& along,
            std::uint32_t from, int interactions, Reached& reached);

}  // namespace kaustik::certify
