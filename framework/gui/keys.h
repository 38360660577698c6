// SPDX-License-Identifier: MIT
// Keys by what is printed on them. GLFW tells keys by their place on a US keyboard, so that the A
// of a French one is its Q.
#pragma once

#include <map>
#include <string_view>

namespace kaustik::gui {

// The GLFW_KEY_… whose name is what the key types without modifiers, UTF-8 ("" for a key that types
// nothing), of a key at that place. The place decides where nothing else can: for F1 or Return, and
// for a letter of another script, since commands have Latin ones. GLFW_KEY_UNKNOWN for another
// character in the place of a letter.
[[nodiscard]] int keyOfCharacter(int place, std::string_view typed);

// Names keys while a keyboard is used. A key is released as what it was pressed as, though the
// layout may have changed since.
class KeyNames {
  public:
    // Takes what a GLFW key callback is told, and gives the key.
    [[nodiscard]] int operator()(int place, int scancode, int action);

  private:
    std::map<int, int> pressed_;  // scancode → key
};

}  // namespace kaustik::gui
