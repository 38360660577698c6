// SPDX-License-Identifier: MIT
#include "framework/run/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "framework/core/error.h"

namespace kaustik::run {
namespace {
volatile std::sig_atomic_t interrupted = 0;

constexpr double kPlainLineIntervalSeconds = 5.0;
}  // namespace

Progress::Progress(std::string what, int total)
    : what_(std::move(what)),
      total_(total),
      isTerminal_(::isatty(STDERR_FILENO) == 1),
      begin_(Clock::now()),
      last_(begin_) {}

Progress::~Progress() {
    if (isTerminal_ && written_) fmt::print(stderr, "\r\033[K");
}

void Progress::update(int done) {
    if (done <= 0 || done > total_) return;
    print(static_cast<double>(done) / total_, fmt::format("{}/{}", done, total_));
}

void Progress::updateShare(double share, const std::string& reached) {
    if (share >= 0.0 && share <= 1.0) print(share, reached);
}

void Progress::print(double share, const std::string& reached) {
    const Clock::time_point now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - begin_).count();
    const double sinceLast = std::chrono::duration<double>(now - last_).count();
    if (!isTerminal_ && (sinceLast < kPlainLineIntervalSeconds || share >= 1.0)) return;
    std::string text = fmt::format("{} {}", what_, reached);
    if (share > 0.0) text += fmt::format(", about {:.0f} s left", elapsed / share * (1.0 - share));
    if (isTerminal_) {
        fmt::print(stderr, "\r\033[K{}", text);
        std::fflush(stderr);
    } else {
        fmt::print(stderr, "{}\n", text);
    }
    written_ = true;
    last_ = now;
}

void catchInterrupts() {
    const auto note = [](int signal) {
        interrupted = 1;
        std::signal(signal, SIG_DFL);
    };
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
}

bool isInterrupted() {
    return interrupted != 0;
}

void throwIfInterrupted() {
    if (interrupted != 0) throw Error("Interrupted; nothing was written.", kExitFailed);
}

}  // namespace kaustik::run
