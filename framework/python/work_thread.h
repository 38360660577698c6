// SPDX-License-Identifier: MIT
// A thread that does one piece of work after the other. An OpenGL context is current on one thread
// only, so that a renderer that is used from any thread needs one of its own; and whoever waits
// for long work can look for Ctrl-C meanwhile.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace kaustik::python {

// Thrown by work that was told to stop.
struct Stopped {};

class WorkThread {
  public:
    // Work is handed what to ask, often: false means that it shall throw Stopped.
    using ShouldContinue = std::function<bool()>;
    using Work = std::function<void(const ShouldContinue& shouldContinue)>;

    WorkThread();
    // Stops the work at hand and waits for it. In a process that was forked off, where the thread
    // is not, it leaves everything as it is.
    ~WorkThread();
    WorkThread(const WorkThread&) = delete;
    WorkThread& operator=(const WorkThread&) = delete;

    // Does the work and waits for it; rethrows what it throws. Callers on several threads wait for
    // each other. `keepWaiting` is asked about every 20 ms on the caller's thread: once it says no,
    // the work is told to stop. Throws Stopped where the work has not begun by then, and
    // DeviceError in a process that was forked off.
    void run(const Work& work, const ShouldContinue& keepWaiting);

    // Work at hand and any later is told to stop at once.
    void stopAll() { stopsAll_ = true; }

  private:
    struct State;
    void loop(State& state);
    [[nodiscard]] bool isForked() const;

    pid_t process_;
    std::atomic<bool> stopsAll_{false};
    std::timed_mutex users_;
    std::unique_ptr<State> state_;
    std::thread thread_;  // last: everything else is there when it begins
};

}  // namespace kaustik::python
