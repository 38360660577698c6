// SPDX-License-Identifier: MIT
// The scale of an image's colours in a column next to it: numbers on the colours themselves, so
// that it takes little from the picture, and their unit in the line of the caption.
#pragma once

#include <imgui.h>

#include <string>

#include "framework/gui/bench.h"
#include "framework/gui/shown_image.h"

namespace kaustik::gui {

// Of the column, as wide as the numbers; 0 where the image has no bar. Window pixels.
[[nodiscard]] float barWidth(const Bench& bench, const ShownImage& image);
// What stands above it: the unit and the power of ten of its numbers.
[[nodiscard]] std::string barUnit(const ShownImage& image);
// `corner`: of the column, which is `height` high. `name`: in the screen map.
void drawColorBar(const Bench& bench, const ShownImage& image, ImVec2 corner, float height,
                  const std::string& name);

}  // namespace kaustik::gui
