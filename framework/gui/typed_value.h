// SPDX-License-Identifier: MIT
// What becomes of a number that someone types into a parameter's field.
#pragma once

#include <string>

#include "framework/params/param_set.h"

namespace kaustik::gui {

struct TypedValue {
    std::string text;     // the parameter's new value; "" where it stays as it was
    std::string problem;  // what is to be said of what was typed; "" for nothing
};

// That the parameter takes, the nearest to a number.
[[nodiscard]] double nearestValue(const params::Field& field, double number);

// A number that the parameter does not take becomes the nearest that it does, which is said; what
// is no number leaves the value as it was, with the sentence that the command line has for it.
[[nodiscard]] TypedValue typedValue(const params::NamedField& named, const std::string& text);
// The same for a width and a height, of which each is a whole number.
[[nodiscard]] TypedValue typedExtent(const params::NamedField& named, params::Extent entered);

}  // namespace kaustik::gui
