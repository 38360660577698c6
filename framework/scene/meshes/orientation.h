// SPDX-License-Identifier: MIT
// Which way the triangles of a mesh face, where its file has not kept to one.
#pragma once

#include <cstddef>

#include "framework/scene/scene.h"

namespace kaustik::scene {

struct Orientation {
    std::size_t turned = 0;        // triangles whose corners go the other way round now
    std::size_t unorientable = 0;  // of surfaces with one side alone, which are left as they are
};

// Makes neighbours face the same way: two triangles that share an edge run along it in opposite
// directions. Of each connected surface the part that covers less area is turned; whether all of it
// is inside out is left alone. Edges of three triangles or more connect nothing. Corners at exactly
// the same position count as one.
Orientation orientTriangles(Mesh& mesh);

}  // namespace kaustik::scene
