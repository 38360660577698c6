// SPDX-License-Identifier: MIT
// What a study varies, as a part of the panel Study: each setting with the values that it takes, to
// be typed or clicked, and the choice of another one.
#pragma once

#include <vector>

#include "framework/gui/bench.h"
#include "framework/gui/study.h"

namespace kaustik::gui {

// Draws the panel's axes (PanelState::studyAxes) for the edited variant, with what is wrong with
// their values, and gives what was typed. Throws ConfigError where the variant's settings make
// none.
[[nodiscard]] std::vector<TypedAxis> drawStudyAxes(Bench& bench);

}  // namespace kaustik::gui
