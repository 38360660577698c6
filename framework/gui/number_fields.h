// SPDX-License-Identifier: MIT
// Numbers that are typed into panels' own fields: what is taken of them is what was typed, or is
// said (of a parameter's, typed_value.h).
#pragma once

#include <optional>
#include <string>

#include "framework/gui/bench.h"

namespace kaustik::gui {

// A field for a whole number, taken over when it is done with. `name`: in the screen map.
void inputCount(Bench& bench, const char* label, int& value, int minimum, int maximum,
                const std::string& name);

// After a slider or a dragged number that took what was typed: brings it back between its ends, and
// says so.
void keepWithin(Bench& bench, const std::string& label, float& value, float minimum, float maximum);
void keepWithin(Bench& bench, const std::string& label, int& value, int minimum, int maximum);

// The whole number that a text is, cut to the ends, and what there is to say of it; no number with
// the reason where it is none. Knows no window.
struct TypedCount {
    std::optional<int> value;
    std::string problem;
};
[[nodiscard]] TypedCount typedCount(const std::string& label, const std::string& text, int minimum,
                                    int maximum);

}  // namespace kaustik::gui
