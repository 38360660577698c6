// SPDX-License-Identifier: MIT
// The desktop that the tests of the workbench use, against the smallest windows there are.
#include "tests/gui/desktop.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <thread>
#include <utility>

#include "framework/core/files.h"
#include "tests/gui/file_drop.h"
#include "tests/unit/temporary_folder.h"
// Last: its macros are common words.
#include <GLFW/glfw3.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;

constexpr int kLeft = 200;
constexpr int kTop = 100;
constexpr int kWidth = 300;
constexpr int kHeight = 150;
constexpr unsigned long kOrange = 0xff8000;
constexpr unsigned long kTeal = 0x008080;

// A window of one colour, on a connection of its own as another program's would be, that keeps what
// happens to it.
class PlainWindow {
  public:
    PlainWindow(const Desktop& desktop, int left, const char* title, unsigned long colour)
        : display_(XOpenDisplay(desktop.name().c_str())) {
        window_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), left, kTop, kWidth,
                                      kHeight, 0, 0, colour);
        XStoreName(display_, window_, title);
        XSelectInput(display_, window_,
                     ButtonPressMask | ButtonReleaseMask | PointerMotionMask | KeyPressMask |
                         KeyReleaseMask | StructureNotifyMask);
        XMapWindow(display_, window_);
        XSync(display_, False);
    }
    ~PlainWindow() { XCloseDisplay(display_); }
    PlainWindow(const PlainWindow&) = delete;
    PlainWindow& operator=(const PlainWindow&) = delete;

    // Since the last call.
    std::vector<XEvent> events() {
        std::vector<XEvent> all;
        XSync(display_, False);
        while (XPending(display_) > 0)
            XNextEvent(display_, &all.emplace_back());
        return all;
    }
    std::vector<XEvent> events(std::initializer_list<int> types) {
        std::vector<XEvent> all = events();
        std::erase_if(all, [&](const XEvent& event) {
            return std::find(types.begin(), types.end(), event.type) == types.end();
        });
        return all;
    }
    // What was typed, as a program that edits text sees it.
    std::string text() {
        std::string typed;
        for (XEvent& event : events({KeyPress})) {
            std::array<char, 8> bytes{};
            const int count =
                XLookupString(&event.xkey, bytes.data(), bytes.size(), nullptr, nullptr);
            typed.append(bytes.data(), static_cast<std::size_t>(count));
        }
        return typed;
    }
    std::string atomName(long atom) {
        char* name = XGetAtomName(display_, static_cast<Atom>(atom));
        const std::string copy = name;
        XFree(name);
        return copy;
    }

  private:
    Display* display_;
    Window window_ = 0;
};

class DesktopTest : public testing::Test {
  protected:
    void focusPlain() { desktop.focus(desktop.windowTitled("Kau").value()); }

    Desktop desktop;
    PlainWindow plain{desktop, kLeft, "Kaustik: a test", kOrange};
};

TEST_F(DesktopTest, AClickArrivesAtItsPixel) {
    desktop.click(kLeft + 17, kTop + 42);
    const std::vector<XEvent> events = plain.events({ButtonPress, ButtonRelease});
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].type, ButtonPress);
    EXPECT_EQ(events[1].type, ButtonRelease);
    EXPECT_EQ(events[0].xbutton.x, 17);
    EXPECT_EQ(events[0].xbutton.y, 42);
    EXPECT_EQ(events[0].xbutton.button, 1u);

    desktop.click(kLeft, kTop, kRightButton);
    EXPECT_EQ(plain.events({ButtonPress}).at(0).xbutton.button, 3u);
    desktop.click(kLeft - 1, kTop);
    EXPECT_TRUE(plain.events({ButtonPress}).empty());
}

TEST_F(DesktopTest, ADragMovesInStepsWithTheButtonDown) {
    desktop.drag(kLeft + 10, kTop + 20, kLeft + 110, kTop + 70, kMiddleButton, 4);
    std::vector<Place> held;
    for (const XEvent& event : plain.events({MotionNotify})) {
        if ((event.xmotion.state & Button2Mask) != 0)
            held.push_back({event.xmotion.x, event.xmotion.y});
    }
    ASSERT_EQ(held.size(), 4u);
    EXPECT_EQ(held[0].x, 35);
    EXPECT_EQ(held[0].y, 32);
    EXPECT_EQ(held[3].x, 110);
    EXPECT_EQ(held[3].y, 70);
}

TEST_F(DesktopTest, TheWheelTurnsBothWays) {
    desktop.wheel(kLeft + 5, kTop + 5, 2);
    desktop.wheel(kLeft + 5, kTop + 5, -3);
    std::map<unsigned, int> notches;
    for (const XEvent& event : plain.events({ButtonPress}))
        ++notches[event.xbutton.button];
    EXPECT_EQ(notches, (std::map<unsigned, int>{{4, 2}, {5, 3}}));
}

TEST_F(DesktopTest, OnAnotherLayoutOtherKeysSayTheSame) {
    const auto codes = [&](const char* character) {
        static_cast<void>(plain.events());
        desktop.key(character);
        std::vector<unsigned> pressed;
        for (const XEvent& event : plain.events({KeyPress}))
            pressed.push_back(event.xkey.keycode);
        return pressed;
    };
    focusPlain();
    const std::vector<unsigned> q = codes("q");
    const std::vector<unsigned> a = codes("a");
    const std::vector<unsigned> zero = codes("0");
    desktop.setLayout("fr");
    EXPECT_EQ(codes("a"), q);
    EXPECT_EQ(codes("q"), a);
    EXPECT_EQ(codes("0").size(), 2u) << "with Shift";
    EXPECT_EQ(codes("0").back(), zero.back());
    desktop.setLayout("us");
    EXPECT_EQ(codes("a"), a);
}

TEST_F(DesktopTest, TextArrivesAsTyped) {
    focusPlain();
    const std::string text = "Set photons=64x32 ../a_b-c/~{\"x\": 0.5e+3}?";
    desktop.type(text);
    EXPECT_EQ(plain.text(), text);
    EXPECT_THROW(desktop.type("\xc3\xbc"), std::runtime_error);
}

TEST_F(DesktopTest, AChordHoldsItsModifiers) {
    focusPlain();
    desktop.key("ctrl+shift+s");
    std::vector<XEvent> events = plain.events({KeyPress, KeyRelease});
    ASSERT_EQ(events.size(), 6u);
    EXPECT_EQ(events[2].xkey.state, static_cast<unsigned>(ControlMask | ShiftMask));
    EXPECT_EQ(XLookupKeysym(&events[2].xkey, 0), static_cast<KeySym>('s'));
    EXPECT_EQ(events[5].type, KeyRelease);

    for (const auto& [name, symbol] : std::map<std::string, KeySym>{{"F1", XK_F1},
                                                                    {"space", XK_space},
                                                                    {"Escape", XK_Escape},
                                                                    {"Return", XK_Return},
                                                                    {"a", XK_a}}) {
        desktop.key(name);
        events = plain.events({KeyPress});
        ASSERT_EQ(events.size(), 1u) << name;
        EXPECT_EQ(XLookupKeysym(&events[0].xkey, 0), symbol) << name;
    }
    desktop.key("ctrl++");
    EXPECT_EQ(XLookupKeysym(&plain.events({KeyPress}).at(2).xkey, 1), static_cast<KeySym>('+'));
    EXPECT_THROW(desktop.key("ctrl+Nonsense"), std::runtime_error);
}

TEST_F(DesktopTest, AKeyThatIsHeldDoesNotRepeat) {
    focusPlain();
    desktop.keyDown("x");
    // X repeats a key after 0.66 seconds by default.
    std::this_thread::sleep_for(std::chrono::seconds(1));
    desktop.keyUp("x");
    EXPECT_EQ(plain.text(), "x");
}

TEST_F(DesktopTest, AScreenshotShowsAWindowWhereItIs) {
    const Image shot = desktop.screenshot();
    ASSERT_EQ(shot.width, 1440);
    ASSERT_EQ(shot.height, 900);
    ASSERT_EQ(shot.channels, 3);
    const auto isOrange = [&](int x, int y) {
        return shot.at(x, y, 0) == 1.0f && shot.at(x, y, 1) == 128.0f / 255.0f &&
               shot.at(x, y, 2) == 0.0f;
    };
    EXPECT_TRUE(isOrange(kLeft, kTop));
    EXPECT_TRUE(isOrange(kLeft + kWidth - 1, kTop + kHeight - 1));
    EXPECT_FALSE(isOrange(kLeft - 1, kTop));
    EXPECT_FALSE(isOrange(kLeft, kTop - 1));
    EXPECT_FALSE(isOrange(kLeft + kWidth, kTop));
    EXPECT_FALSE(isOrange(kLeft, kTop + kHeight));
}

TEST_F(DesktopTest, AScreenshotIsKeptWhereTheEnvironmentSays) {
    const TemporaryFolder folder;
    ::setenv("KAUSTIK_TEST_OUTPUT", (folder / "").c_str(), 1);
    const fs::path file = desktop.keepScreenshot("orange");
    ::unsetenv("KAUSTIK_TEST_OUTPUT");
    EXPECT_EQ(file, folder / "gui" / ("orange" + displayImageExtension()));
    EXPECT_EQ(readImage(file).at(kLeft, kTop, 1), 128.0f / 255.0f);
}

TEST_F(DesktopTest, KeysGoToTheWindowThatHasTheFocus) {
    PlainWindow other(desktop, kLeft + kWidth, "Another", kTeal);
    focusPlain();
    desktop.type("one");
    desktop.focus(desktop.windowTitled("Anoth").value());
    desktop.type("two");
    EXPECT_EQ(plain.text(), "one");
    EXPECT_EQ(other.text(), "two");
    EXPECT_FALSE(desktop.windowTitled("Nothing"));
    EXPECT_EQ(desktop.originOf(desktop.windowTitled("Anoth").value()).x, kLeft + kWidth);
}

TEST_F(DesktopTest, AWindowIsAskedToClose) {
    desktop.close(desktop.windowTitled("Kau").value());
    const std::vector<XEvent> events = plain.events({ClientMessage});
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(plain.atomName(events[0].xclient.data.l[0]), "WM_DELETE_WINDOW");
}

TEST_F(DesktopTest, TwoDesktopsAreApart) {
    Desktop other(320, 240);
    EXPECT_NE(other.name(), desktop.name());
    EXPECT_EQ(other.screenshot().width, 320);
    other.click(kLeft + 1, kTop + 1);
    EXPECT_TRUE(plain.events({ButtonPress}).empty());
}

TEST_F(DesktopTest, AWindowThatTakesNoFilesIsSaidSo) {
    EXPECT_THROW(desktop.dropFiles({"/tmp/a"}, kLeft + 1, kTop + 1), std::runtime_error);
}

TEST(UriList, HasALineForEachFile) {
    EXPECT_EQ(uriList({"/a/plain-name_1.toml",
                       "/b/K\xc3\xbc"
                       "ste 50%.obj"}),
              "file:///a/plain-name_1.toml\r\nfile:///b/K%C3%BCste%2050%25.obj\r\n");
}

// A window of GLFW's, as the workbench's is, in a process of its own. It writes a file with the
// place and the paths of the first drop and ends, or ends when it is closed.
class GlfwProcess {
  public:
    GlfwProcess(const Desktop& desktop, const fs::path& result) {
        process_ = ::fork();
        if (process_ != 0) return;
        ::setenv("DISPLAY", desktop.name().c_str(), 1);
        ::_exit(run(result) ? 0 : 1);
    }
    ~GlfwProcess() {
        if (process_ > 0) ::kill(process_, SIGKILL);
        if (process_ > 0) ::waitpid(process_, nullptr, 0);
    }
    GlfwProcess(const GlfwProcess&) = delete;
    GlfwProcess& operator=(const GlfwProcess&) = delete;

    [[nodiscard]] int wait() {
        int status = -1;
        ::waitpid(std::exchange(process_, -1), &status, 0);
        return status;
    }

  private:
    static bool run(fs::path result) {
        if (glfwInit() != GLFW_TRUE) return false;
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        GLFWwindow* window =
            glfwCreateWindow(400, 300, "Kaustik \xe2\x80\x94 drop", nullptr, nullptr);
        if (window == nullptr) return false;
        glfwSetWindowPos(window, 70, 30);
        glfwSetWindowUserPointer(window, &result);
        glfwSetDropCallback(window, [](GLFWwindow* target, int count, const char** paths) {
            double x = 0.0;
            double y = 0.0;
            glfwGetCursorPos(target, &x, &y);
            std::string lines =
                std::to_string(std::lround(x)) + " " + std::to_string(std::lround(y)) + "\n";
            for (int i = 0; i < count; ++i)
                lines += std::string(paths[i]) + "\n";
            writeFileWhole(*static_cast<const fs::path*>(glfwGetWindowUserPointer(target)), lines);
            glfwSetWindowShouldClose(target, GLFW_TRUE);
        });
        while (glfwWindowShouldClose(window) == GLFW_FALSE)
            glfwWaitEvents();
        glfwTerminate();
        return true;
    }

    pid_t process_ = -1;
};

WindowId awaitKaustik(const Desktop& desktop) {
    for (;;) {
        if (const auto window = desktop.windowTitled("Kaustik")) {
            if (desktop.originOf(*window).x == 70) return *window;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

TEST(GlfwWindow, TakesTheFilesThatAreDroppedOnIt) {
    Desktop desktop;
    const TemporaryFolder folder;
    const std::vector<fs::path> files = {folder / "two words.toml",
                                         folder /
                                             "K\xc3\xbc"
                                             "ste & B\xc3\xa4r 100%.obj"};
    GlfwProcess process(desktop, folder / "dropped");
    static_cast<void>(awaitKaustik(desktop));
    desktop.dropFiles(files, 70 + 123, 30 + 45);
    EXPECT_EQ(process.wait(), 0);
    EXPECT_EQ(readFile(folder / "dropped"),
              "123 45\n" + files[0].string() + "\n" + files[1].string() + "\n");
}

TEST(GlfwWindow, IsFoundByATitleOutsideAsciiAndCloses) {
    Desktop desktop;
    const TemporaryFolder folder;
    GlfwProcess process(desktop, folder / "dropped");
    const WindowId window = awaitKaustik(desktop);
    desktop.focus(window);
    desktop.close(window);
    EXPECT_EQ(process.wait(), 0);
    EXPECT_FALSE(fs::exists(folder / "dropped"));
}

}  // namespace
}  // namespace kaustik::test
