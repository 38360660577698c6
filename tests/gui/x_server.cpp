// SPDX-License-Identifier: MIT
#include "tests/gui/x_server.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

#include "framework/core/files.h"

namespace kaustik::test {
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

    // All memory is had before the fork: the child may only make system calls.
    const std::string descriptor = std::to_string(ends[1]);
    const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24";
    const std::string messages = (messages_ / "err").string();
    // At 96 dots to an inch GLFW and others scale by 1; Xvfb by itself says 100.
    const std::array<const char*, 13> words = {
        "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0",          screen.c_str(),
        "-dpi", "96",         "-nolisten",        "tcp",     "+extension", "GLX",
        nullptr};
    const pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ == 0) {
        // With SIGTERM the server takes its lock file away.
        ::prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (::getppid() != parent) ::_exit(1);
        const int file = ::open(messages.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
        ::dup2(file, STDOUT_FILENO);
        ::dup2(file, STDERR_FILENO);
        ::fcntl(ends[1], F_SETFD, 0);
        ::execvp(words[0], const_cast<char* const*>(words.data()));
        ::_exit(127);
    }
    ::close(ends[1]);
    const std::string number = process_ > 0 ? lineFrom(ends[0]) : "";
    ::close(ends[0]);
    if (number.empty()) {
        std::string said;
        if (process_ > 0) {
            ::kill(process_, SIGKILL);
            ::waitpid(process_, nullptr, 0);
            said = readFile(messages_ / "err");
        }
        throw std::runtime_error("Xvfb does not start; is it installed (package xvfb)? " + said);
    }
    display_ = ":" + number;
}

XServer::~XServer() {
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
}

}  // namespace kaustik::test
