// SPDX-License-Identifier: MIT
// What of a triangle lies behind other facets, seen from the light.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/certify/geometry.h"
#include "framework/certify/polygon.h"

namespace kaustik::certify {

// Of one facet, in the triangle's barycentrics of its second and third corner: what may be in
// shadow, and what is for sure.
struct Shadow {
    Region outer;
    Region inner;
};

// The facet `dropped` throws none (PlantedError).
[[nodiscard]] std::vector<Shadow> findShadows(const Geometry& geometry, const Source& source,
                                              std::uint32_t triangle, std::uint32_t dropped);

}  // namespace kaustik::certify
