// SPDX-License-Identifier: MIT
#include "framework/scene/pixel_size.h"

#include <cmath>

namespace kaustik::scene {

double diagonalOf(const Bounds& bounds) {
    return bounds.empty ? 0.0 : glm::length(bounds.maximum - bounds.minimum);
}

double pixelMeters(const Scene& scene, int rows) {
    const Bounds all = sceneBounds(scene);
    const double sight = glm::length(0.5 * (all.minimum + all.maximum) - scene.camera.position);
    return 2.0 * std::tan(0.5 * glm::radians(scene.camera.verticalFovDegrees)) * sight / rows;
}

}  // namespace kaustik::scene
