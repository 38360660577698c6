// SPDX-License-Identifier: MIT
// Which dielectrics with an inside are one body to whoever knows of each body a front and a back:
// those whose surfaces meet, or of which one lies in the other. Boxes that overlap are not enough:
// a ball beside a dragon's leg is a body of its own.
#pragma once

#include <cstddef>
#include <vector>

#include "framework/scene/scene.h"

namespace kaustik::scene {

// Places in the scene's objects, a group a body, in the order of their first objects. By triangles
// of meshes as they are, not as waves move them.
[[nodiscard]] std::vector<std::vector<std::size_t>> connectedBodies(const Scene& scene);

}  // namespace kaustik::scene
