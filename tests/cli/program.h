// SPDX-License-Identifier: MIT
// Runs the program as a user does, in a process of its own, and keeps what it prints.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/process.h"
#include "tests/unit/temporary_folder.h"

namespace kaustik::test {

struct Outcome {
    int exitCode = -1;  // minus the signal that ended it
    std::string out;    // standard output
    std::string err;    // standard error
};

struct Conditions {
    std::filesystem::path folder = ".";              // where it is started
    std::map<std::string, std::string> environment;  // besides the test's own
    std::optional<rlim_t> largestFileBytes;          // that it may write
    std::filesystem::path standardOutput;            // instead of Outcome::out
    std::filesystem::path program;                   // a copy of it; "" for the one that was built
};

// It is ended with this, if it still runs.
class Program {
  public:
    // Starts `kaustik arguments…`.
    explicit Program(const std::vector<std::string>& arguments, const Conditions& conditions = {});

    // Returns once it handles `signal` by itself, or has ended.
    void waitUntilItHandles(int signal) const;
    void send(int signal) const;
    [[nodiscard]] bool isRunning() const;
    // How it has ended, before wait(): "exit code 0", "signal 11"; "" while it runs.
    [[nodiscard]] std::string ending() const;
    // What it has written to standard error so far.
    [[nodiscard]] std::string messages() const;
    [[nodiscard]] Outcome wait();

  private:
    TemporaryFolder captured_;
    Process process_;
};

// Runs to the end.
[[nodiscard]] Outcome runKaustik(const std::vector<std::string>& arguments,
                                 const Conditions& conditions = {});

// `kaustik run` with next to nothing to render, then `more`.
[[nodiscard]] std::vector<std::string> smallRun(const std::string& scene,
                                                const std::vector<std::string>& more = {});

}  // namespace kaustik::test
