// SPDX-License-Identifier: MIT
// `kaustik gui` in a process of its own, used as everybody does: it is told by --describe where its
// controls are, and the mouse and the keyboard of a desktop do the rest.
//
// A control is named as in framework/gui/screen_map.h. Each input returns once the workbench has
// taken it and shown what came of it, or has ended. What cannot be done is a std::runtime_error
// with what the workbench has written to standard error.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/gui/desktop.h"

namespace kaustik::test {

// Pixels of the window's contents.
struct Rectangle {
    double x = 0.0;
    double y = 0.0;
    double w = 0.0;
    double h = 0.0;
};

// Where in a control, in parts of its width and height.
struct Spot {
    double x = 0.5;
    double y = 0.5;
};

// How a control is made ready for typing.
enum class Entry {
    click,         // a field for text: whatever is in it is selected, so that it is replaced
    controlClick,  // a slider or a dragged number, which turns into such a field
};

class WorkbenchProcess {
  public:
    using Json = nlohmann::json;

    // Starts `kaustik gui arguments…` in `folder`. Its settings and its cache are in there as well,
    // so that a second one in the same folder finds what the first has left.
    WorkbenchProcess(Desktop& desktop, const std::filesystem::path& folder,
                     const std::vector<std::string>& arguments = {},
                     const std::map<std::string, std::string>& environment = {});

    // The latest description; waits for the first.
    [[nodiscard]] Json screen();
    [[nodiscard]] Json status() { return screen().at("status"); }
    [[nodiscard]] bool has(const std::string& control);
    [[nodiscard]] Rectangle control(const std::string& name);
    [[nodiscard]] std::string value(const std::string& control);

    // Returns once `isSo` is true of the description; a field that isn't there yet is waited for.
    // `what` completes "The workbench never showed ...".
    void waitFor(const std::string& what, const std::function<bool(const Json&)>& isSo);

    // Mouse, in the middle of what is in sight of the control or at another spot of it.
    void hover(const std::string& control, Spot spot = {});
    void click(const std::string& control, unsigned button = kLeftButton, Spot spot = {});
    // As a hand's, it takes an interface that is not too slow: 12 frames a second or more.
    void doubleClick(const std::string& control);
    void drag(const std::string& control, int dx, int dy, unsigned button = kLeftButton,
              Spot spot = {});
    void wheel(const std::string& control, int notches, Spot spot = {});
    void dropFiles(const std::vector<std::filesystem::path>& files, const std::string& control);

    // Keyboard.
    void keyDown(const std::string& chord);
    void keyUp(const std::string& chord);
    void key(const std::string& chord);
    void type(const std::string& text);
    // Replaces what the control says, and ends with that key, "" for none.
    void typeInto(const std::string& control, const std::string& text, Entry entry = Entry::click,
                  const std::string& lastKey = "Return", Spot spot = {});

    // The button in the window's frame, which is not there on this desktop.
    void close();
    [[nodiscard]] bool isRunning() const { return program_.isRunning(); }
    // Returns once it has ended by itself.
    [[nodiscard]] Outcome wait();
    // Ends it at once, as a crash does.
    void kill();

    // Returns once everything that the workbench had been told by now is in its description.
    void untilTaken();
    // Returns once all that is described by now is on the desktop.
    void untilDrawn();
    std::filesystem::path keepScreenshot(const std::string& name);

  private:
    [[nodiscard]] std::optional<Json> description() const;
    [[nodiscard]] Json entryOf(const std::string& control);
    [[nodiscard]] long frame() const;  // of the latest description, -1 before the first
    [[nodiscard]] WindowId window();
    [[nodiscard]] Place placeOf(const std::string& control, Spot spot = {});  // on the desktop
    // Of what has just been sent, `isTaken` says of a description whether it was of a frame that
    // had it.
    void untilTaken(const std::function<bool(const Json&)>& isTaken);
    void untilStrokesTaken(long before, long count);
    [[nodiscard]] long strokes() const;  // that the latest description says to be taken
    void moveTo(Place place);
    void press(unsigned button);
    void release(unsigned button);
    // Polls until `isSo`, or until it has ended (false). Throws at the limit.
    bool poll(const std::string& what, const std::function<bool()>& isSo) const;
    [[noreturn]] void fail(const std::string& message) const;

    Desktop& desktop_;
    std::filesystem::path file_;
    Program program_;
    std::optional<WindowId> window_;
};

}  // namespace kaustik::test
