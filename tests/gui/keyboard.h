// SPDX-License-Identifier: MIT
// Which keys a text or a chord takes on the keyboard of an X server.
#pragma once

#include <string>
#include <vector>

struct _XDisplay;

namespace kaustik::test {

// The keys of "ctrl+shift+s", in the order in which they go down; a character that is printed on
// the upper half of a key brings Shift with it. Throws std::runtime_error where there is no such
// key.
[[nodiscard]] std::vector<unsigned> keyCodesOf(_XDisplay* display, const std::string& chord);

}  // namespace kaustik::test
