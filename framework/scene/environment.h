// SPDX-License-Identifier: MIT
// The environment of a scene (Scene::environmentImage): where a direction falls in its
// latitude-longitude picture, and pictures that need no file.
#pragma once

#include <glm/glm.hpp>

#include "framework/image/image.h"
#include "framework/scene/scene.h"

namespace kaustik::scene {

// The place in the picture where a direction (unit, world space) falls: (0, 0) is the lower left,
// (1, 1) the upper right; x is in [0, 1). Straight up and straight down it is the middle of the
// edge, turned.
[[nodiscard]] glm::dvec2 environmentPosition(const Scene& scene, const glm::dvec3& direction);

// Pictures as a scene file names them. Linear RGB around 1, which the background radiance
// multiplies.
enum class EnvironmentPattern {
    sky,   // clouds above a bright horizon, dark ground with paths below
    grid,  // squares of 10 degrees, each side of the world in its own colour
};
[[nodiscard]] Image makeEnvironment(EnvironmentPattern pattern);

}  // namespace kaustik::scene
