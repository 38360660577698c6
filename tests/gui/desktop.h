// SPDX-License-Identifier: MIT
// A desktop of the test's own, with a mouse and a keyboard: an X server without a screen, and the
// XTEST extension, whose events no program can tell from those of a hand. Nothing manages windows
// here: they have no frames, and the keyboard goes where focus() says.
//
// Places are in pixels of the desktop from its upper left corner. All events have reached their
// windows' connections when a function returns; whether a program has taken them is for the program
// to say. Errors are std::runtime_error.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/image/image.h"
#include "tests/gui/x_server.h"

struct _XDisplay;

namespace kaustik::test {

using WindowId = unsigned long;

enum MouseButton : unsigned { kLeftButton = 1, kMiddleButton = 2, kRightButton = 3 };

struct Place {
    int x = 0;
    int y = 0;
};

class Desktop {
  public:
    explicit Desktop(int width = 1440, int height = 900);

    // What windows that come from now on take for the screen's pixels to the inch; it is 96 at
    // first.
    void setDensity(int pixelsPerInch);

    // For the variable DISPLAY.
    [[nodiscard]] const std::string& name() const { return server_.display(); }

    // The mouse. It moves in a few steps, in a straight line.
    void moveTo(int x, int y, int steps = 5);
    void press(unsigned button = kLeftButton);
    void release(unsigned button = kLeftButton);
    void click(int x, int y, unsigned button = kLeftButton);
    void drag(int x0, int y0, int x1, int y1, unsigned button = kLeftButton, int steps = 10);
    void wheel(int x, int y, int notches);  // away from the hand (up) is positive

    // The keyboard, a US one at first, on which no key repeats. Another layout ("fr", "de") prints
    // other characters on the same keys, also for programs that run already. A chord is the name of
    // a key (a character or X's name of it, as "F1", "Escape", "Return"), after modifiers:
    // "ctrl+shift+s", "ctrl++".
    void setLayout(const std::string& layout);
    void keyDown(const std::string& chord);
    void keyUp(const std::string& chord);
    void key(const std::string& chord);
    void type(std::string_view text);  // printable ASCII, '\n' and '\t'

    // A window whose title begins so, once it can be seen.
    [[nodiscard]] std::optional<WindowId> windowTitled(std::string_view beginning) const;
    // Where the upper left corner of its contents is.
    [[nodiscard]] Place originOf(WindowId window) const;
    // Gives it the keyboard.
    void focus(WindowId window);
    // Asks it to close, as the button in a window's frame does.
    void close(WindowId window);

    // Drags files, which need not exist, from a file manager to that place and drops them there.
    // Throws when the window there takes no files, or hasn't taken them in that time.
    void dropFiles(const std::vector<std::filesystem::path>& files, int x, int y,
                   std::chrono::seconds limit = std::chrono::seconds(300));

    // Three channels, display-encoded.
    [[nodiscard]] Image screenshot() const;
    // Writes it as gui/NAME.png into the folder $KAUSTIK_TEST_OUTPUT, by default test-output in the
    // folder of the build, and returns the file.
    std::filesystem::path keepScreenshot(const std::string& name) const;

  private:
    struct Disconnect {
        void operator()(_XDisplay* display) const;
    };

    void connect();
    void sendKey(unsigned keyCode, bool isDown);

    XServer server_;
    std::unique_ptr<_XDisplay, Disconnect> display_;
    WindowId root_ = 0;
};

}  // namespace kaustik::test
