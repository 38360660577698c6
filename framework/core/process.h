// SPDX-License-Identifier: MIT
// Another program in a process of its own: the one place that starts one.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace kaustik {

// What a standard descriptor of the new process may be, besides one of this process's.
inline constexpr int kNoDescriptor = -1;      // /dev/null
inline constexpr int kSharedDescriptor = -2;  // this process's own

struct ProcessPlan {
    std::filesystem::path program = {};   // a name without '/' is looked for as a shell does
    std::vector<std::string> words = {};  // what it sees as its command line, its own name first
    // Input, output, messages.
    std::array<int, 3> standard{kNoDescriptor, kNoDescriptor, kNoDescriptor};
    std::optional<int> inherited = {};  // one more, under its number
    bool closesOthers = false;          // also those that were not opened to be closed
    std::optional<std::vector<std::string>> environment = {};  // NAME=value; else this process's
    std::filesystem::path folder = {};                         // where it is; else as this process
    std::optional<rlim_t> maxFileBytes = {};                   // that it may write
    bool hasOwnGroup = false;        // a key pressed at the terminal does not reach it
    bool hasDefaultSignals = false;  // whatever this process does about signals
    int signalWithParent = 0;        // that it gets when the thread that has started it ends
};

struct ProcessEnd {
    int exitCode = -1;  // where no signal has ended it
    int signal = 0;     // that has ended it
};

class Process {
  public:
    Process() = default;
    ~Process();  // ends it if it still runs
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    // Gives errno where it cannot be started, else 0. The one before must have ended.
    [[nodiscard]] int start(const ProcessPlan& plan);
    [[nodiscard]] bool hasStarted() const { return id_ > 0; }  // and its end is not known yet
    [[nodiscard]] pid_t id() const { return id_; }
    void send(int signal) const;
    // How it has ended, or none if it still runs after that time.
    [[nodiscard]] std::optional<ProcessEnd> endWithin(std::chrono::milliseconds time) const;
    // Waits for its end, after which there is nothing left of it.
    ProcessEnd wait();

  private:
    pid_t id_ = -1;
};

// Everything that this process would hand on, NAME=value.
[[nodiscard]] std::vector<std::string> processEnvironment();

}  // namespace kaustik
