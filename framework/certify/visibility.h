// SPDX-License-Identifier: MIT
// Which facets the rays of a cell may hit next, and which of the cell's rays hit which of them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "framework/certify/ray.h"

namespace kaustik::certify {

// The box around polygons of the cell, by a hair wider.
struct CellExtent {
    Point low{1e300, 1e300};
    Point high{-1e300, -1e300};
};

// A facet that a ray may hit.
struct Candidate {
    std::uint32_t facet = 0;
    double along = 1.0;  // the sign of direction · normal
    Region region;       // of the cell, from where it is met
    Polygons may;        // what of the ray is in the region
    CellExtent extent;   // of `may`
};

// Light that may meet more facets than that is not worth to be followed to each.
inline constexpr std::size_t kManyCandidates = 128;

// All that rays from the box in directions of the box may hit, whatever stands before it; of more
// than kManyCandidates one more. The facet `dropped` is none (PlantedError).
[[nodiscard]] std::vector<Candidate> findCandidates(const Geometry& geometry, const Ray& ray,
                                                    const Vec& start, const Vec& velocity,
                                                    std::uint32_t dropped);

// What of the ray hits the target first.
struct Visible {
    Polygons sure;
    Polygons may;
};
[[nodiscard]] Visible visiblePart(const Geometry& geometry, const Ray& ray,
                                  const std::vector<Candidate>& candidates,
                                  const Candidate& target);

}  // namespace kaustik::certify
