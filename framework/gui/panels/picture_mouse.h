// SPDX-License-Identifier: MIT
// The hand on the picture: what the mouse takes hold of, drags and zooms, and the keys that fly.
#pragma once

#include <imgui.h>

#include "framework/gui/bench.h"
#include "framework/gui/panels/picture_overlay.h"

namespace kaustik::gui {

// What the mouse holds while a button is down.
enum class DragTarget { none, camera, look, middle, split, light };

struct DragState {
    DragTarget hold = DragTarget::none;
    int light = -1;
    ImVec2 pressed;  // where
    bool hasMoved = false;
    // Whether it changes what is worked on, and not only how it is seen.
    [[nodiscard]] bool changesDocument() const {
        return hold == DragTarget::camera || hold == DragTarget::look || hold == DragTarget::light;
    }
};

// What a press takes hold of. What is not seen by the eye is moved itself, and not the eye.
// `pointedLight`: as drawLights() gives it.
[[nodiscard]] DragState beginDrag(bool isNearSplit, int pointedLight, bool isEyes);
// Takes over how far the mouse has moved in this frame.
void applyDrag(Bench& bench, const PictureFrame& frame, DragState& hand);
// Zooms about the mouse, or, with Ctrl on a picture of the eye's, moves the eye there.
void useWheel(Bench& bench, const PictureFrame& frame, bool isEyes);
// As the keys of Bench::flight were held.
void fly(Bench& bench);

}  // namespace kaustik::gui
