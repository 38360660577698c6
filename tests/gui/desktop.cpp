// SPDX-License-Identifier: MIT
#include "tests/gui/desktop.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "tests/gui/file_drop.h"
#include "tests/gui/keyboard.h"

namespace kaustik::test {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

// Between two events, as a quick hand would.
constexpr auto kPause = std::chrono::milliseconds(4);
// How long a button or a key is down in a click.
constexpr auto kHold = std::chrono::milliseconds(20);

// Other programs' windows may go at any time, so that a question about one is no mistake of ours.
int onError(Display* display, XErrorEvent* error) {
    const bool isOfWindow = error->error_code == BadWindow || error->error_code == BadDrawable ||
                            error->error_code == BadMatch;
    if (isOfWindow) return 0;
    char text[256];
    XGetErrorText(display, error->error_code, text, sizeof(text));
    std::fprintf(stderr, "X error: %s (request %d)\n", text, error->request_code);
    return 0;
}

std::string titleOf(Display* display, Window window) {
    Atom type = 0;
    int format = 0;
    unsigned long count = 0;
    unsigned long more = 0;
    unsigned char* title = nullptr;
    std::string result;
    for (const Atom property : {XInternAtom(display, "_NET_WM_NAME", False), Atom{XA_WM_NAME}}) {
        XGetWindowProperty(display, window, property, 0, 1024, False, AnyPropertyType, &type,
                           &format, &count, &more, &title);
        if (title == nullptr) continue;
        if (format == 8) result.assign(reinterpret_cast<const char*>(title), count);
        XFree(title);
        title = nullptr;
        if (!result.empty()) break;
    }
    return result;
}

bool isViewable(Display* display, Window window) {
    XWindowAttributes attributes{};
    return XGetWindowAttributes(display, window, &attributes) != 0 &&
           attributes.map_state == IsViewable;
}

std::optional<Window> find(Display* display, Window parent, std::string_view beginning) {
    Window root = 0;
    Window grandparent = 0;
    Window* children = nullptr;
    unsigned count = 0;
    if (XQueryTree(display, parent, &root, &grandparent, &children, &count) == 0) return {};
    std::optional<Window> found;
    // The uppermost is the last.
    for (unsigned i = count; i-- > 0 && !found;) {
        const bool isIt = isViewable(display, children[i]) &&
                          titleOf(display, children[i]).starts_with(beginning);
        found = isIt ? children[i] : find(display, children[i], beginning);
    }
    if (children != nullptr) XFree(children);
    return found;
}

// The part of `pixel` under `mask`, in [0, 1].
float channelOf(unsigned long pixel, unsigned long mask) {
    return static_cast<float>(pixel & mask) / static_cast<float>(mask);
}

}  // namespace

void Desktop::Disconnect::operator()(_XDisplay* display) const {
    XCloseDisplay(display);
}

Desktop::Desktop(int width, int height) : server_(width, height) {
    XSetErrorHandler(onError);
    connect();
}

void Desktop::connect() {
    display_.reset(XOpenDisplay(name().c_str()));
    if (!display_) throw std::runtime_error("Xvfb takes no connection on " + name() + ".");
    int ignored = 0;
    if (XTestQueryExtension(display_.get(), &ignored, &ignored, &ignored, &ignored) == 0)
        throw std::runtime_error("Xvfb has no XTEST extension.");
    root_ = DefaultRootWindow(display_.get());
    // A key that is held until a slow program has seen it stays one key.
    XAutoRepeatOff(display_.get());
    XSync(display_.get(), False);
}

void Desktop::setDensity(int pixelsPerInch) {
    const std::string resources = "Xft.dpi: " + std::to_string(pixelsPerInch) + "\n";
    XChangeProperty(display_.get(), root_, XA_RESOURCE_MANAGER, XA_STRING, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(resources.data()),
                    static_cast<int>(resources.size()));
    XSync(display_.get(), False);
}

void Desktop::moveTo(int x, int y, int steps) {
    Window window = 0;
    Place from;
    Place local;
    unsigned buttons = 0;
    XQueryPointer(display_.get(), root_, &window, &window, &from.x, &from.y, &local.x, &local.y,
                  &buttons);
    for (int step = 1; step <= steps; ++step) {
        XTestFakeMotionEvent(display_.get(), -1, from.x + (x - from.x) * step / steps,
                             from.y + (y - from.y) * step / steps, CurrentTime);
        XSync(display_.get(), False);
        std::this_thread::sleep_for(kPause);
    }
}

void Desktop::press(unsigned button) {
    XTestFakeButtonEvent(display_.get(), button, True, CurrentTime);
    XSync(display_.get(), False);
    std::this_thread::sleep_for(kPause);
}

void Desktop::release(unsigned button) {
    XTestFakeButtonEvent(display_.get(), button, False, CurrentTime);
    XSync(display_.get(), False);
    std::this_thread::sleep_for(kPause);
}

void Desktop::click(int x, int y, unsigned button) {
    moveTo(x, y);
    press(button);
    std::this_thread::sleep_for(kHold);
    release(button);
}

void Desktop::drag(int x0, int y0, int x1, int y1, unsigned button, int steps) {
    moveTo(x0, y0);
    press(button);
    std::this_thread::sleep_for(kHold);
    moveTo(x1, y1, steps);
    std::this_thread::sleep_for(kHold);
    release(button);
}

void Desktop::wheel(int x, int y, int notches) {
    constexpr unsigned up = 4;
    constexpr unsigned down = 5;
    moveTo(x, y);
    for (int notch = 0; notch < std::abs(notches); ++notch) {
        press(notches > 0 ? up : down);
        release(notches > 0 ? up : down);
    }
}

void Desktop::setLayout(const std::string& layout) {
    const std::string command = "setxkbmap -display " + name() + " -layout " + layout;
    if (std::system(command.c_str()) != 0)
        throw std::runtime_error("'" + command + "' fails; is it installed (x11-xkb-utils)?");
    connect();  // which keeps what the keys say
}

void Desktop::sendKey(unsigned keyCode, bool isDown) {
    XTestFakeKeyEvent(display_.get(), keyCode, isDown ? True : False, CurrentTime);
    XSync(display_.get(), False);
    std::this_thread::sleep_for(kPause);
}

void Desktop::keyDown(const std::string& chord) {
    for (const unsigned code : keyCodesOf(display_.get(), chord))
        sendKey(code, true);
}

void Desktop::keyUp(const std::string& chord) {
    const std::vector<unsigned> codes = keyCodesOf(display_.get(), chord);
    for (auto code = codes.rbegin(); code != codes.rend(); ++code)
        sendKey(*code, false);
}

void Desktop::key(const std::string& chord) {
    keyDown(chord);
    std::this_thread::sleep_for(kHold);
    keyUp(chord);
}

void Desktop::type(std::string_view text) {
    for (const char c : text) {
        const std::string character(1, c);
        keyDown(character);
        keyUp(character);
    }
}

std::optional<WindowId> Desktop::windowTitled(std::string_view beginning) const {
    return find(display_.get(), root_, beginning);
}

Place Desktop::originOf(WindowId window) const {
    Place place;
    Window child = 0;
    if (XTranslateCoordinates(display_.get(), window, root_, 0, 0, &place.x, &place.y, &child) == 0)
        throw std::runtime_error("The window is on no screen.");
    return place;
}

void Desktop::focus(WindowId window) {
    // Not a measure of speed: a window that has just been made may take its time to be seen.
    constexpr auto limit = std::chrono::seconds(60);
    const auto end = Clock::now() + limit;
    for (;;) {
        XRaiseWindow(display_.get(), window);
        XSetInputFocus(display_.get(), window, RevertToPointerRoot, CurrentTime);
        Window focused = 0;
        int revertTo = 0;
        XGetInputFocus(display_.get(), &focused, &revertTo);
        if (focused == window) break;
        if (Clock::now() > end) throw std::runtime_error("The window does not take the keyboard.");
        std::this_thread::sleep_for(kPause);
    }
}

void Desktop::close(WindowId window) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = window;
    event.xclient.message_type = XInternAtom(display_.get(), "WM_PROTOCOLS", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] =
        static_cast<long>(XInternAtom(display_.get(), "WM_DELETE_WINDOW", False));
    XSendEvent(display_.get(), window, False, NoEventMask, &event);
    XSync(display_.get(), False);
}

void Desktop::dropFiles(const std::vector<fs::path>& files, int x, int y,
                        std::chrono::seconds limit) {
    moveTo(x, y);
    test::dropFiles(display_.get(), files, x, y, limit);
}

Image Desktop::screenshot() const {
    XWindowAttributes attributes{};
    XGetWindowAttributes(display_.get(), root_, &attributes);
    const auto free = [](XImage* image) { XDestroyImage(image); };
    const std::unique_ptr<XImage, decltype(free)> shot(
        XGetImage(display_.get(), root_, 0, 0, static_cast<unsigned>(attributes.width),
                  static_cast<unsigned>(attributes.height), AllPlanes, ZPixmap),
        free);
    if (!shot) throw std::runtime_error("The X server gives no image of its screen.");
    Image image(shot->width, shot->height, 3);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const unsigned long pixel = XGetPixel(shot.get(), x, y);
            image.at(x, y, 0) = channelOf(pixel, shot->red_mask);
            image.at(x, y, 1) = channelOf(pixel, shot->green_mask);
            image.at(x, y, 2) = channelOf(pixel, shot->blue_mask);
        }
    }
    return image;
}

fs::path Desktop::keepScreenshot(const std::string& name) const {
    const char* folder = std::getenv("KAUSTIK_TEST_OUTPUT");
    const fs::path file = fs::path(folder != nullptr ? folder : KAUSTIK_TEST_OUTPUT) / "gui" /
                          (name + displayImageExtension());
    fs::create_directories(file.parent_path());
    writeImage(file, screenshot());
    return file;
}

}  // namespace kaustik::test
