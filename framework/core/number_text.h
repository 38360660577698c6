// SPDX-License-Identifier: MIT
// Numbers as people are told them.
#pragma once

#include <string>

namespace kaustik {

// A limit or a setting as somebody would write it: all digits of a whole number ("268435456", not
// "2.68435e+08"), and of any other the fewest that read back as the same float ("0.01").
[[nodiscard]] std::string numberText(double number);

}  // namespace kaustik
