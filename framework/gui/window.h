// SPDX-License-Identifier: MIT
// The workbench's window: GLFW with an OpenGL context of its own, and Dear ImGui in it. Knows
// nothing of what is drawn.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "framework/gui/imgui_keys.h"
#include "framework/gui/keys.h"

struct GLFWwindow;

namespace kaustik::gui {

class Window {
  public:
    struct Placement {
        int width = 1440;
        int height = 900;
        int x = -1;  // negative: wherever the system puts it
        int y = -1;
    };

    // Throws DeviceError (exit code 1) that says what is missing and names `kaustik run`, which
    // needs no window. `imguiSettings`: where Dear ImGui keeps its own.
    Window(const std::string& title, const Placement& placement,
           const std::filesystem::path& imguiSettings);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    [[nodiscard]] bool isClosing() const;
    void close();
    // Hides the window at once, whatever is still to be put away.
    void hide();
    // Waits for input, but not longer than so many seconds; then begins a frame of the interface.
    void beginFrame(double waitSeconds);
    // Draws it, not seen yet.
    void drawFrame();
    // Shows it. Throws DeviceError (exit code 3) when the window's context is lost.
    void endFrame();
    // Ends a wait from any thread.
    static void wake();

    // A key that went down since the last frame, however shortly; by what is printed on it.
    struct KeyPress {
        int key = 0;        // GLFW_KEY_…
        int modifiers = 0;  // GLFW_MOD_…
    };
    [[nodiscard]] const std::vector<KeyPress>& keyPresses() const { return keyPresses_; }
    // How long the key at that place of a US keyboard was down since the last frame, s, whatever is
    // printed on it; of a tap as long as a frame of 60 a second at least.
    [[nodiscard]] double heldSeconds(int place) const;

    // Files that were dropped on the window since the last call.
    [[nodiscard]] std::vector<std::string> takeDropped();
    [[nodiscard]] Placement placement() const;
    [[nodiscard]] float scale() const { return scale_; }  // of the interface, 1 at 96 dpi
    // What was drawn and is not shown yet, 8 bits RGB, top row first: what is seen is not readable
    // on every platform.
    [[nodiscard]] std::vector<float> readPixels(int& width, int& height) const;
    // How often keys and buttons of the mouse have gone down or up.
    [[nodiscard]] long strokes() const { return strokes_; }
    // Whether anything has happened that needs more than one frame to settle.
    [[nodiscard]] bool hadInput() const { return hadInput_; }
    [[nodiscard]] const std::string& renderer() const { return renderer_; }

  private:
    void loadFont();

    GLFWwindow* window_ = nullptr;
    std::string iniFile_;
    std::string renderer_;
    std::vector<std::string> dropped_;
    KeyNames keyNames_;
    Clipboard clipboard_;
    std::vector<KeyPress> keyPresses_;
    void noteKey(int place, int key, int action, int modifiers);
    struct Held {
        double since = -1.0;  // of GLFW's clock; below 0: it is up
        double seconds = 0.0;
    };
    std::map<int, Held> held_;  // by place
    float scale_ = 1.0f;
    bool hadInput_ = true;
    long strokes_ = 0;
    bool isRobust_ = false;
};

}  // namespace kaustik::gui
