// SPDX-License-Identifier: MIT
// What is on the screen, in words: every control by name with its rectangle and value, and how the
// workbench does. Written as JSON where `kaustik gui --describe FILE` asks for it, so that tests
// (or a screen reader) can find a control and use it with the mouse as everybody does.
//
//   {"frame": 812, "controls": {"passes.on.trace.hierarchical": {"x": 12, "y": 80, "w": 17, "h":
//   17,
//    "value": "on"}, …}, "status": {"scene": "pool", …}}
//
// x, y: the upper left corner, pixels of the window's contents.
#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace kaustik::gui {

class ScreenMap {
  public:
    explicit ScreenMap(std::filesystem::path file) : file_(std::move(file)) {}
    [[nodiscard]] bool isOn() const { return !file_.empty(); }

    void beginFrame();
    // The control that was drawn last, where any of it can be seen.
    void control(const std::string& name, const std::string& value = "");
    void area(const std::string& name, float x, float y, float width, float height,
              const std::string& value = "");
    template <class Value>
    void status(const std::string& name, const Value& value) {
        if (isOn()) json_["status"][name] = value;
    }
    // Writes the file, at most so often that it costs nothing.
    void endFrame();

  private:
    using Clock = std::chrono::steady_clock;
    std::filesystem::path file_;
    nlohmann::json json_;
    Clock::time_point written_;
};

}  // namespace kaustik::gui
