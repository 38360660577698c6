// SPDX-License-Identifier: MIT
// Keys between GLFW and Dear ImGui, which up to 1.86 numbers them as GLFW does and since 1.87 has
// numbers of its own. Everything else names a key by its GLFW_KEY_….
#pragma once

#include <string>

struct GLFWwindow;

namespace kaustik::gui {

// Tells Dear ImGui what a GLFW key callback was told, of a key by what is printed on it (keys.h).
void sendKey(GLFWwindow* window, int key, int scancode, int action, int modifiers);

// While a slider's or a dragged number is typed, a comma of this frame becomes a point: Dear ImGui
// would leave it out, and 0,05 would be 5. After ImGui::NewFrame().
void typePointForComma();
// Dear ImGui's clipboard, with points in the place of commas where a fraction is pasted.
class Clipboard {
  public:
    // After GLFW's side of Dear ImGui was set up; it must live as long.
    void use(GLFWwindow* window);

  private:
    [[nodiscard]] const char* read();

    GLFWwindow* window_ = nullptr;
    std::string withPoints_;
};

}  // namespace kaustik::gui
