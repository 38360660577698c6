// SPDX-License-Identifier: MIT
// How large a scene is, and what a pixel sees of it, about: scales for what may be left out.
#pragma once

#include "framework/scene/scene.h"

namespace kaustik::scene {

// m; 0 of what is empty.
[[nodiscard]] double diagonalOf(const Bounds& bounds);
// Of a picture of so many rows, at the middle of the scene, m.
[[nodiscard]] double pixelMeters(const Scene& scene, int rows);

}  // namespace kaustik::scene
