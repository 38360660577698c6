// SPDX-License-Identifier: MIT
#include "tests/gui/x_server.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <stdexcept>

#include "framework/core/files.h"

namespace kaustik::test {
namespace fs = std::filesystem;
namespace {

// Not a measure of speed: a machine that has much else to do may need long.
constexpr int kStartLimitMilliseconds = 120'000;

// The first line that comes through `descriptor`, or "" when it closes or the time is over.
std::string lineFrom(int descriptor) {
    std::string line;
    for (;;) {
        pollfd readable{descriptor, POLLIN, 0};
        std::array<char, 16> bytes{};
        if (::poll(&readable, 1, kStartLimitMilliseconds) != 1) return "";
        const ssize_t count = ::read(descriptor, bytes.data(), bytes.size());
        if (count <= 0) return "";
        line.append(bytes.data(), static_cast<std::size_t>(count));
        if (line.back() == '\n') return line.substr(0, line.size() - 1);
    }
}

}  // namespace

XServer::XServer(int width, int height) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("There is no pipe left.");

    const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24";
    const fs::path messages = messages_ / "err";
    const int file = ::open(messages.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    // At 96 dots to an inch GLFW and others scale by 1; Xvfb by itself says 100. With SIGTERM the
    // server takes its lock file away.
    const int problem =
        process_.start({.program = "Xvfb",
                        .words = {"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0",
                                  screen, "-dpi", "96", "-nolisten", "tcp", "+extension", "GLX"},
                        .standard = {kSharedDescriptor, file, file},
                        .inherited = ends[1],
                        .signalWithParent = SIGTERM});
    ::close(file);
    ::close(ends[1]);
    const std::string number = problem == 0 ? lineFrom(ends[0]) : "";
    ::close(ends[0]);
    if (number.empty()) {
        throw std::runtime_error("Xvfb does not start; is it installed (package xvfb)? " +
                                 (problem == 0 ? readFile(messages) : std::strerror(problem)));
    }
    display_ = ":" + number;
}

XServer::~XServer() {
    process_.send(SIGTERM);
    static_cast<void>(process_.wait());
}

}  // namespace kaustik::test
