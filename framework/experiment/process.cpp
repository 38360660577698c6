// SPDX-License-Identifier: MIT
#include "framework/experiment/process.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <sstream>

#include "framework/core/error.h"
#include "framework/core/process.h"

namespace kaustik::experiment {
namespace {

constexpr std::chrono::milliseconds kTimeBetweenLooks{50};

// A file descriptor that is closed at the end.
class Descriptor {
  public:
    explicit Descriptor(int value) : value_(value) {}
    ~Descriptor() {
        if (value_ >= 0) ::close(value_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int value() const { return value_; }

  private:
    int value_;
};

std::string readAll(int file) {
    std::string text;
    std::array<char, 4096> block{};
    off_t offset = 0;
    for (;;) {
        const ssize_t count = ::pread(file, block.data(), block.size(), offset);
        if (count <= 0) return text;
        text.append(block.data(), static_cast<std::size_t>(count));
        offset += count;
    }
}

}  // namespace

ProcessOutcome runProcess(const std::filesystem::path& program,
                          const std::vector<std::string>& words, StandardOutput output,
                          const std::function<bool()>& isInterrupted, int endingSignal) {
    const Descriptor messages(::memfd_create("messages", MFD_CLOEXEC));
    const ProcessPlan plan{
        .program = program,
        .words = words,
        .standard = {kNoDescriptor,
                     output == StandardOutput::dropped ? kNoDescriptor : kSharedDescriptor,
                     messages.value()},
        .hasOwnGroup = true,
        .signalWithParent = SIGKILL};
    Process process;
    if (const int problem = messages.value() < 0 ? errno : process.start(plan)) {
        throw IoError(
            fmt::format("{} cannot be started: {}.", program.string(), std::strerror(problem)));
    }
    ProcessOutcome outcome;
    // Waits in short steps, so that a signal that comes between two of them is not missed.
    while (!process.endWithin(kTimeBetweenLooks)) {
        if (!isInterrupted()) continue;
        outcome.interrupted = true;
        process.send(endingSignal);
        break;
    }
    const ProcessEnd end = process.wait();
    outcome.messages = readAll(messages.value());
    outcome.exitCode = end.exitCode;
    if (end.signal != 0) outcome.signal = ::strsignal(end.signal);
    return outcome;
}

std::string ProcessOutcome::problem() const {
    if (exitCode == 0) return "";
    if (!signal.empty()) return fmt::format("It was ended by a signal: {}.", signal);
    // The last line that the program wrote as its own; what drivers print may surround it.
    std::string last;
    std::string own;
    std::istringstream lines(messages);
    constexpr std::string_view kOwn = "kaustik: ";
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(kOwn)) own = line.substr(kOwn.size());
        if (!line.empty()) last = line;
    }
    if (!own.empty()) return own;
    if (!last.empty()) return last;
    return fmt::format("It ended with exit code {}.", exitCode);
}

}  // namespace kaustik::experiment
