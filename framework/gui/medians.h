// SPDX-License-Identifier: MIT
// The times that the window says of several frames.
#pragma once

#include <vector>

namespace kaustik::gui {

// The median as the report has it; 0 of nothing.
[[nodiscard]] double medianOf(std::vector<double> values);
// Of the frames since a change, without the first, which compiles what the change asks for, where
// there are more.
[[nodiscard]] double settledMedianOf(const std::vector<double>& values);

}  // namespace kaustik::gui
