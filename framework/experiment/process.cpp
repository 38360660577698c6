// SPDX-License-Identifier: MIT
#include "framework/experiment/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <sstream>

#include "framework/core/error.h"

namespace kaustik::experiment {
namespace {

constexpr int kMillisecondsBetweenLooks = 50;
constexpr int kExitNotStarted = 127;

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

// In the child: system calls only, since nothing else is safe after a fork.
[[noreturn]] void become(const char* program, char* const* words, int nowhere, int messages,
                         StandardOutput output, pid_t parent) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const bool orphaned = ::getppid() != parent;
    bool ready = ::dup2(nowhere, STDIN_FILENO) == STDIN_FILENO &&
                 ::dup2(messages, STDERR_FILENO) == STDERR_FILENO;
    if (output == StandardOutput::dropped) {
        ready = ready && ::dup2(nowhere, STDOUT_FILENO) == STDOUT_FILENO;
    }
    if (ready && !orphaned) ::execv(program, words);
    ::_exit(kExitNotStarted);
}

}  // namespace

ProcessOutcome runProcess(const std::filesystem::path& program,
                          const std::vector<std::string>& words, StandardOutput output,
                          const std::function<bool()>& isInterrupted) {
    const Descriptor messages(::memfd_create("messages", MFD_CLOEXEC));
    const Descriptor nowhere(::open("/dev/null", O_RDWR | O_CLOEXEC));
    const std::string path = program.string();
    std::vector<std::string> copies = words;
    std::vector<char*> pointers;
    for (std::string& word : copies)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);

    const pid_t parent = ::getpid();
    const pid_t child = messages.value() < 0 || nowhere.value() < 0 ? -1 : ::fork();
    if (child == 0) {
        become(path.c_str(), pointers.data(), nowhere.value(), messages.value(), output, parent);
    }
    if (child < 0) {
        throw IoError(fmt::format("{} cannot be started: {}.", path, std::strerror(errno)));
    }
    ProcessOutcome outcome;
    // By its number: glibc 2.36 declares its wrapper for C alone.
    const Descriptor handle(static_cast<int>(::syscall(SYS_pidfd_open, child, 0)));
    pollfd ended{handle.value(), POLLIN, 0};
    // Waits in short steps, so that a signal that comes between two of them is not missed.
    while (::poll(&ended, 1, kMillisecondsBetweenLooks) <= 0) {
        if (!isInterrupted()) continue;
        outcome.interrupted = true;
        ::kill(child, SIGKILL);
        break;
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    outcome.messages = readAll(messages.value());
    if (WIFEXITED(status)) outcome.exitCode = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = ::strsignal(WTERMSIG(status));
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
    return exitCode == kExitNotStarted ? "It could not be started."
                                       : fmt::format("It ended with exit code {}.", exitCode);
}

}  // namespace kaustik::experiment
