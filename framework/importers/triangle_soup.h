// SPDX-License-Identifier: MIT
// Makes a Mesh out of the loose triangles that an importer found: recentred, welded, with normals.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

// Vertices as an importer found them, in the mesh's space; `triangles` index them.
struct TriangleSoup {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;  // zero or not finite: to be made from the faces
    std::vector<glm::vec2> uvs;
    std::vector<glm::uvec3> triangles;
};

struct BuiltMesh {
    Mesh mesh;
    std::size_t degenerateCount = 0;  // triangles that were dropped: no area
    std::size_t madeNormalCount = 0;  // vertices whose normal was made from the faces
    // Triangles that faced against their neighbours and were turned, and those of surfaces that
    // have one side alone (meshes/orientation.h).
    std::size_t turnedCount = 0;
    std::size_t unorientableCount = 0;
    double windingBehind = 1.0;  // meshes/winding_number.h: near 0 where the mesh is inside out

    // What to tell of it, in sentences without a subject.
    [[nodiscard]] std::vector<std::string> oddities() const;
};

// All arrays have one entry a vertex and the indices are in range (asserted). Identical vertices
// are joined, by exact comparison, so that it does not depend on the size of the mesh; unused ones
// are left out. Triangles with a repeated position or with all corners on a line are dropped;
// `closed` is found before that, after neighbours were made to face the same way, since a sliver
// that fills a T-junction has no area but does close the surface. Missing normals are the mean of
// the face normals around the position, weighted by the angle at the corner (Thürmer and Wüthrich
// 1998). Throws IoError that begins with `where` for positions that are not finite, or when no
// triangle is left.
[[nodiscard]] BuiltMesh buildMesh(const TriangleSoup& soup, const std::string& name,
                                  const std::string& where);

// Six times the volume inside a closed mesh, in the units of the mesh cubed; negative when its
// faces are clockwise seen from outside, so that it is inside out.
[[nodiscard]] double signedVolumeTimesSix(const Mesh& mesh);

}  // namespace kaustik::scene
