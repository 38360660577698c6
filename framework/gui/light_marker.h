// SPDX-License-Identifier: MIT
// Finds the place where a light's handle is marked in the window: on the handle itself where it is
// seen, else at the edge of what is seen, on the way there, with the direction in which it lies.
// The mark moves with the view and without jumps, also where the handle passes behind the eye.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "framework/render/view.h"

namespace kaustik::gui {

// The place of the picture of `view`, in pixels of the window; y goes down.
struct PictureArea {
    glm::dvec2 low{0.0};  // of the part of the window in which marks may be
    glm::dvec2 high{0.0};
    glm::dvec2 origin{0.0};  // of the picture's upper left corner, which may be outside
    double zoom = 1.0;       // window pixels a pixel
};

struct LightMarker {
    glm::dvec2 place{0.0};  // window
    // Unit, towards where the handle lies; 0 where the mark is on it.
    glm::dvec2 direction{0.0};
    bool isBehind = false;  // the eye, so that no hand can drag it
};

// `margin`: least distance of a mark from the edges, pixels. Nothing where there is no way to point
// to, straight behind the eye, and where the area has no room.
[[nodiscard]] std::optional<LightMarker> markLight(const render::RasterView& view,
                                                   const glm::dvec3& handleWs,
                                                   const PictureArea& area, double margin);

}  // namespace kaustik::gui
