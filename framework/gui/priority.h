// SPDX-License-Identifier: MIT
// On a software rasteriser frames, references and the window want the same cores; the window goes
// first.
#pragma once

namespace kaustik::gui {

constexpr int kFramePriority = 15;
constexpr int kBackgroundPriority = 19;  // what nobody waits for: references, thumbnails

// Of the calling thread and those that it starts from now on, the rasteriser's among them. Has no
// effect after keepPriority().
void lowerPriority(int niceness);

// All threads of this process are as urgent as the window, from now on: next to other work on the
// same cores, one that is less urgent would never get ready.
void keepPriority();

}  // namespace kaustik::gui
