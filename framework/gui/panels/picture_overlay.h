// SPDX-License-Identifier: MIT
// What lies over the picture: handles of lights and the paths of photons.
#pragma once

#include <imgui.h>

#include <glm/glm.hpp>

#include "framework/gui/bench.h"
#include "framework/render/view.h"

namespace kaustik::gui {

// The place of the picture in the window.
struct PictureFrame {
    ImVec2 corner;  // of the area
    ImVec2 size;
    ImVec2 low;  // of the whole picture, which may be larger than the area
    ImVec2 high;
    float zoom = 1.0f;  // window pixels a pixel of the image
    float reduction = 1.0f;
    int width = 1;  // of the picture
    int height = 1;

    [[nodiscard]] glm::vec2 pixelAt(ImVec2 p) const {
        return {(p.x - low.x) / zoom, (p.y - low.y) / zoom};
    }
    [[nodiscard]] ImVec2 windowAt(glm::vec2 pixel) const {
        return {low.x + pixel.x * zoom, low.y + pixel.y * zoom};
    }
    [[nodiscard]] bool contains(glm::ivec2 pixel) const {
        return pixel.x >= 0 && pixel.y >= 0 && pixel.x < width && pixel.y < height;
    }
};

[[nodiscard]] render::RasterView eyeViewOf(const Bench& bench, const PictureFrame& frame);

// The light whose handle is under the mouse and can be dragged; -1: none. `held`: the one that is
// being dragged.
int drawLights(Bench& bench, const PictureFrame& frame, bool isHovered, int held);

void drawPhotons(const Bench& bench, const PictureFrame& frame);

}  // namespace kaustik::gui
