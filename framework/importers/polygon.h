// SPDX-License-Identifier: MIT
// Cuts polygons of any size into triangles, by ear clipping (Meisters 1975): a corner whose
// triangle holds no other corner is cut off, until three are left. Only corners that bend inwards
// can lie in such a triangle; they are kept in a k-d tree, and a corner is looked at again only
// when a neighbour of its has gone, so that time grows about as the number of corners does.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace kaustik::scene {

struct CutPolygon {
    std::vector<glm::uvec3> triangles;  // corners by index; turn as the polygon does; n - 2
    // False where no corner was left that could be cut off without harm, as in a polygon that
    // crosses itself: then triangles may overlap.
    bool isSimple = true;
    // Steps that it took: corners looked at, and visits to the tree.
    std::size_t work = 0;
};

// Cuts a polygon of at least three corners, in order. Where they do not lie in a plane, it is cut
// as it is seen along the mean normal.
[[nodiscard]] CutPolygon cutPolygon(std::span<const glm::dvec3> corners);

}  // namespace kaustik::scene
