// SPDX-License-Identifier: MIT
#include "framework/gui/keys.h"

#define GLFW_INCLUDE_NONE  // OpenGL comes from epoxy
#include <GLFW/glfw3.h>

#include <array>
#include <utility>

namespace kaustik::gui {

int keyOfCharacter(int place, std::string_view typed) {
    static constexpr std::array<std::pair<char, int>, 11> kSigns = {{
        {'\'', GLFW_KEY_APOSTROPHE},
        {',', GLFW_KEY_COMMA},
        {'-', GLFW_KEY_MINUS},
        {'.', GLFW_KEY_PERIOD},
        {'/', GLFW_KEY_SLASH},
        {';', GLFW_KEY_SEMICOLON},
        {'=', GLFW_KEY_EQUAL},
        {'[', GLFW_KEY_LEFT_BRACKET},
        {'\\', GLFW_KEY_BACKSLASH},
        {']', GLFW_KEY_RIGHT_BRACKET},
        {'`', GLFW_KEY_GRAVE_ACCENT},
    }};
    const bool isOnKeypad = place >= GLFW_KEY_KP_0 && place <= GLFW_KEY_KP_EQUAL;
    const bool isAscii = typed.size() == 1 && static_cast<unsigned char>(typed[0]) < 0x80;
    if (isOnKeypad || !isAscii) return place;
    const char c = typed[0];
    if (c >= 'a' && c <= 'z') return GLFW_KEY_A + (c - 'a');
    if (c >= 'A' && c <= 'Z') return GLFW_KEY_A + (c - 'A');
    if (c >= '0' && c <= '9') return GLFW_KEY_0 + (c - '0');
    for (const auto& [sign, key] : kSigns) {
        if (sign == c) return key;
    }
    const bool isLettersPlace = place >= GLFW_KEY_A && place <= GLFW_KEY_Z;
    return isLettersPlace ? GLFW_KEY_UNKNOWN : place;
}

int KeyNames::operator()(int place, int scancode, int action) {
    if (action == GLFW_RELEASE) {
        const auto known = pressed_.find(scancode);
        if (known == pressed_.end()) return place;
        const int key = known->second;
        pressed_.erase(known);
        return key;
    }
    const char* typed = glfwGetKeyName(GLFW_KEY_UNKNOWN, scancode);
    const int key = keyOfCharacter(place, typed != nullptr ? typed : "");
    if (action == GLFW_PRESS) pressed_[scancode] = key;
    return key;
}

}  // namespace kaustik::gui
