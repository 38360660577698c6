// SPDX-License-Identifier: MIT
#include "tests/gui/file_drop.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <poll.h>

#include <array>
#include <cctype>
#include <functional>
#include <stdexcept>
#include <string_view>

namespace kaustik::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr long kVersion = 5;

// The window that the files come from, and its talk with the one that they go to.
class Source {
  public:
    Source(Display* display, std::string files, std::chrono::milliseconds limit)
        : display_(display), files_(std::move(files)), end_(Clock::now() + limit) {
        window_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), -9, -9, 1, 1, 0, 0, 0);
        XSelectInput(display_, window_, PropertyChangeMask);
        time_ = serverTime();
        XSetSelectionOwner(display_, atom("XdndSelection"), window_, time_);
    }
    ~Source() {
        XDestroyWindow(display_, window_);
        XSync(display_, False);
    }
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    void drop(int x, int y) {
        target_ = windowAt(x, y);
        const long here = static_cast<long>(window_);
        const long time = static_cast<long>(time_);
        const long copy = static_cast<long>(atom("XdndActionCopy"));
        send("XdndEnter", {here, kVersion << 24, static_cast<long>(atom("text/uri-list")), 0, 0});
        send("XdndPosition", {here, 0, static_cast<long>(x) << 16 | y, time, copy});
        if ((awaitMessage("XdndStatus").data.l[1] & 1) == 0) {
            send("XdndLeave", {here, 0, 0, 0, 0});
            throw std::runtime_error("The window takes no files at this place.");
        }
        send("XdndDrop", {here, 0, time, 0, 0});
        // Only the lowest bit says in version 5 whether the files were taken, but GLFW 3.3 sends
        // the number of bytes there.
        if (awaitMessage("XdndFinished").data.l[1] == 0) {
            throw std::runtime_error("The window has not taken the files.");
        }
    }

  private:
    [[nodiscard]] Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

    void send(const char* type, const std::array<long, 5>& data) const {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target_;
        event.xclient.message_type = atom(type);
        event.xclient.format = 32;
        for (std::size_t i = 0; i < data.size(); ++i)
            event.xclient.data.l[i] = data[i];
        XSendEvent(display_, target_, False, NoEventMask, &event);
        XFlush(display_);
    }

    // Answers the target's requests meanwhile.
    XEvent awaitEvent(const std::string& what, const std::function<bool(const XEvent&)>& isIt) {
        for (;;) {
            while (XPending(display_) > 0) {
                XEvent event;
                XNextEvent(display_, &event);
                if (isIt(event)) return event;
                if (event.type == SelectionRequest) answer(event.xselectionrequest);
            }
            const auto left =
                std::chrono::duration_cast<std::chrono::milliseconds>(end_ - Clock::now()).count();
            if (left <= 0) throw std::runtime_error("No " + what + " from the window in time.");
            pollfd readable{ConnectionNumber(display_), POLLIN, 0};
            ::poll(&readable, 1, static_cast<int>(left));
        }
    }

    XClientMessageEvent awaitMessage(const char* type) {
        const Atom wanted = atom(type);
        return awaitEvent(type,
                          [&](const XEvent& event) {
                              return event.type == ClientMessage &&
                                     event.xclient.message_type == wanted;
                          })
            .xclient;
    }

    // X gives the time with an event only.
    Time serverTime() {
        XChangeProperty(display_, window_, XA_WM_NAME, XA_STRING, 8, PropModeAppend, nullptr, 0);
        return awaitEvent("time", [](const XEvent& event) { return event.type == PropertyNotify; })
            .xproperty.time;
    }

    void answer(const XSelectionRequestEvent& request) const {
        XEvent reply{};
        reply.xselection.type = SelectionNotify;
        reply.xselection.requestor = request.requestor;
        reply.xselection.selection = request.selection;
        reply.xselection.target = request.target;
        reply.xselection.time = request.time;
        if (request.target == atom("text/uri-list")) {
            reply.xselection.property = request.property;
            XChangeProperty(display_, request.requestor, request.property, request.target, 8,
                            PropModeReplace, reinterpret_cast<const unsigned char*>(files_.data()),
                            static_cast<int>(files_.size()));
        }
        XSendEvent(display_, request.requestor, False, NoEventMask, &reply);
        XFlush(display_);
    }

    // The outermost window at this place that takes files.
    [[nodiscard]] Window windowAt(int x, int y) const {
        const Window root = DefaultRootWindow(display_);
        Window child = root;
        int localX = 0;
        int localY = 0;
        for (Window parent = root; child != 0; parent = child) {
            if (parent != root && isAware(parent)) return parent;
            if (XTranslateCoordinates(display_, root, parent, x, y, &localX, &localY, &child) == 0)
                break;
        }
        throw std::runtime_error("There is no window that takes files at this place.");
    }

    [[nodiscard]] bool isAware(Window window) const {
        Atom type = 0;
        int format = 0;
        unsigned long count = 0;
        unsigned long more = 0;
        unsigned char* version = nullptr;
        XGetWindowProperty(display_, window, atom("XdndAware"), 0, 1, False, AnyPropertyType, &type,
                           &format, &count, &more, &version);
        if (version != nullptr) XFree(version);
        return count == 1;
    }

    Display* display_;
    std::string files_;
    Clock::time_point end_;
    Window window_ = 0;
    Window target_ = 0;
    Time time_ = 0;
};

}  // namespace

std::string uriList(const std::vector<std::filesystem::path>& files) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    constexpr std::string_view plain = "/-._~";
    std::string list;
    for (const std::filesystem::path& file : files) {
        list += "file://";
        for (const char c : std::filesystem::absolute(file).string()) {
            const auto byte = static_cast<unsigned char>(c);
            if (byte < 128 && (std::isalnum(byte) != 0 || plain.find(c) != plain.npos)) {
                list += c;
            } else {
                list += {'%', digits[byte >> 4], digits[byte & 15u]};
            }
        }
        list += "\r\n";
    }
    return list;
}

void dropFiles(_XDisplay* display, const std::vector<std::filesystem::path>& files, int x, int y,
               std::chrono::milliseconds limit) {
    Source(display, uriList(files), limit).drop(x, y);
}

}  // namespace kaustik::test
