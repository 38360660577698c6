// SPDX-License-Identifier: MIT
// Where their picture lies, to a fraction of a pixel.
#pragma once

#include <glm/glm.hpp>

#include "framework/judge/comparison.h"

namespace kaustik::judge {

// Smaller moves and changes of scale are not spoken of, however significant: a tenth of the half
// pixel that conventions differ by, and what moves the edge of a picture of 200 pixels by as much.
constexpr double kMinShiftPixels = 0.05;
constexpr double kMinScale = 0.0015;  // relative

// Standard errors of a registration.
struct PlacementError {
    glm::dvec2 shiftPixels{0.0};
    double scale = 0.0;  // relative
};

// Refines `registration` together with all causes: what moves a caustic may be another index. Makes
// the columns with causes, and aligns.
PlacementError refinePlacement(Comparison& comparison);
// Whether the registration moves or scales their picture.
[[nodiscard]] bool isMoved(const Comparison& comparison);

}  // namespace kaustik::judge
