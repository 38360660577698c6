// SPDX-License-Identifier: MIT
// What a pixel sees, about: a scale for what may be left out.
#pragma once

#include "framework/scene/scene.h"

namespace kaustik::scene {

// Of a picture of so many rows, at the middle of the scene, m.
[[nodiscard]] double pixelMeters(const Scene& scene, int rows);

}  // namespace kaustik::scene
