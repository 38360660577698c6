// SPDX-License-Identifier: MIT
// How far long work has come, on standard error: one line that is written over on a terminal, plain
// lines now and then otherwise. And whether the user has asked to stop.
#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace kaustik::run {

class Progress {
  public:
    explicit Progress(std::string what, int total = 0);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    // `done` of the total are finished.
    void update(int done);
    // Reports work that is not counted: a share in [0,1], and what has been reached.
    void updateShare(double share, const std::string& reached);

  private:
    using Clock = std::chrono::steady_clock;
    void print(double share, const std::string& reached);

    std::string what_;
    int total_;
    bool isTerminal_;
    bool written_ = false;
    Clock::time_point begin_;
    Clock::time_point last_;
};

// Who watches long work instead of a terminal, and may end it.
struct Watch {
    std::function<bool()> shouldContinue;  // asked on any thread, often
    std::function<void(double share, const std::string& reached)> tell;  // one call at a time
};

// Notes Ctrl-C and SIGTERM from now on instead of ending the program; a second one ends it.
void catchInterrupts();
[[nodiscard]] bool isInterrupted();
// Throws Error when one was noted.
void throwIfInterrupted();

}  // namespace kaustik::run
