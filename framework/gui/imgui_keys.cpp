// SPDX-License-Identifier: MIT
#include "framework/gui/imgui_keys.h"

#define GLFW_INCLUDE_NONE  // OpenGL comes from epoxy
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string>

namespace kaustik::gui {
namespace {

#if IMGUI_VERSION_NUM >= 18700

// Of keys that type something and of function keys; ImGuiKey_None for others.
ImGuiKey imguiKey(int key) {
    struct Range {
        int first, last;  // GLFW_KEY_…
        ImGuiKey imguiFirst;
    };
    // Dear ImGui has the same order in each of them.
    static constexpr Range kRanges[] = {
        {GLFW_KEY_SPACE, GLFW_KEY_SPACE, ImGuiKey_Space},
        {GLFW_KEY_APOSTROPHE, GLFW_KEY_APOSTROPHE, ImGuiKey_Apostrophe},
        {GLFW_KEY_COMMA, GLFW_KEY_SLASH, ImGuiKey_Comma},
        {GLFW_KEY_0, GLFW_KEY_9, ImGuiKey_0},
        {GLFW_KEY_SEMICOLON, GLFW_KEY_SEMICOLON, ImGuiKey_Semicolon},
        {GLFW_KEY_EQUAL, GLFW_KEY_EQUAL, ImGuiKey_Equal},
        {GLFW_KEY_A, GLFW_KEY_Z, ImGuiKey_A},
        {GLFW_KEY_LEFT_BRACKET, GLFW_KEY_RIGHT_BRACKET, ImGuiKey_LeftBracket},
        {GLFW_KEY_GRAVE_ACCENT, GLFW_KEY_GRAVE_ACCENT, ImGuiKey_GraveAccent},
        {GLFW_KEY_F1, GLFW_KEY_F12, ImGuiKey_F1},
    };
    for (const Range& range : kRanges) {
        if (key >= range.first && key <= range.last)
            return static_cast<ImGuiKey>(range.imguiFirst + (key - range.first));
    }
    return ImGuiKey_None;
}

#endif

// Of sliders and dragged numbers, which turn into a field; text and whole numbers are no such.
bool isFractionTyped() {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    return context.ActiveId != 0 && context.TempInputId == context.ActiveId;
}

}  // namespace

void sendKey(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
#if IMGUI_VERSION_NUM >= 18700
    // Its callback would look up once more what is printed on the key.
    if (const ImGuiKey known = imguiKey(key); known != ImGuiKey_None) {
        if (action != GLFW_REPEAT) ImGui::GetIO().AddKeyEvent(known, action == GLFW_PRESS);
        return;
    }
#endif
    ImGui_ImplGlfw_KeyCallback(window, key, scancode, action, modifiers);
}

void typePointForComma() {
    if (!isFractionTyped()) return;
    for (ImWchar& character : ImGui::GetIO().InputQueueCharacters) {
        if (character == ',') character = '.';
    }
}

void Clipboard::use(GLFWwindow* window) {
    window_ = window;
    ImGuiIO& io = ImGui::GetIO();
    io.ClipboardUserData = this;
    io.GetClipboardTextFn = [](void* self) { return static_cast<Clipboard*>(self)->read(); };
    io.SetClipboardTextFn = [](void* self, const char* text) {
        glfwSetClipboardString(static_cast<Clipboard*>(self)->window_, text);
    };
}

const char* Clipboard::read() {
    const char* text = glfwGetClipboardString(window_);
    if (text == nullptr || !isFractionTyped()) return text;
    withPoints_ = text;
    std::replace(withPoints_.begin(), withPoints_.end(), ',', '.');
    return withPoints_.c_str();
}

}  // namespace kaustik::gui
