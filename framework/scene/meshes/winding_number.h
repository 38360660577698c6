// SPDX-License-Identifier: MIT
// Whether a mesh bounds a volume, for meshes as others make them: with seams, slivers and holes.
#pragma once

#include "framework/scene/scene.h"

namespace kaustik::scene {

// How often the mesh goes around a point of its own space, m: the sum of its triangles' solid
// angles over 4 pi (the generalised winding number; Jacobson, Kavan, Sorkine-Hornung 2013). 1 in a
// body that is closed, 0 outside; where a surface is open, what lies between. On the surface, it is
// the mean of both sides.
[[nodiscard]] double windingNumber(const Mesh& mesh, const glm::dvec3& point);

// The winding number just behind the surface, its mean over the area: 1 for a closed body, 1/2 for
// a level sheet, 0 for a body inside out. By points that the area is divided among, so that slivers
// count by theirs; 1/2 where there is no area.
[[nodiscard]] double meanWindingBehind(const Mesh& mesh);

// Whether a mesh with that winding number behind it has an inside. A quarter is allowed to holes: a
// teapot with open seams and half a ball have one (about 1 and 0.8), waves that break do not.
[[nodiscard]] bool boundsVolume(double windingBehind);

// Whether more than a thousandth of the area faces away from what most of it faces: a wave that
// breaks, which a straight line can cross more than once.
[[nodiscard]] bool turnsBack(const Mesh& mesh);

}  // namespace kaustik::scene
