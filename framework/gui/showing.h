// SPDX-License-Identifier: MIT
// Which images are on the screen: the one that is looked at, and to the right of the split what it
// is compared with, the newest frame's, a kept one's, the reference or a difference. Knows no
// window.
#pragma once

#include <optional>
#include <string>

#include "framework/gui/shown_image.h"

namespace kaustik::gui {

// Both sides of the split, and what a difference is to be taken of.
struct Showing {
    std::optional<ShownImage> main;
    std::optional<ShownImage> compared;    // to the right of the split, where there is one
    std::string words;                     // in the place of an image
    std::optional<ShownImage> subtrahend;  // where a difference is asked for
    std::string comparedProblem;  // why nothing is to the right of the split although asked for
};

// `reference`: of the same document as the result, or nothing is shown of it.
[[nodiscard]] Showing showingOf(const ShownRequest& requested, const FrameResult& result,
                                const ReferenceState& reference);

// How good a reference is: "8 million photons, its own noise 2.1 %".
[[nodiscard]] std::string noteOf(const ReferenceState& reference);

// Why two images cannot stand next to each other at one scale; "" where they can.
[[nodiscard]] std::string whyNotComparable(const ShownImage& a, const ShownImage& b);

}  // namespace kaustik::gui
