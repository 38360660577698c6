// SPDX-License-Identifier: MIT
#include "framework/python/work_thread.h"

#include <unistd.h>

#include <chrono>
#include <utility>

#include "framework/core/error.h"

namespace kaustik::python {
namespace {
constexpr std::chrono::milliseconds kPollInterval{20};
}  // namespace

struct WorkThread::State {
    std::mutex mutex;
    std::condition_variable changed;
    const Work* work = nullptr;  // null: nothing to do
    bool isDone = false;
    bool ends = false;
    std::exception_ptr failure;
    std::atomic<bool> stops{false};
};

WorkThread::WorkThread()
    : process_(::getpid()), state_(std::make_unique<State>()), thread_([this] { loop(*state_); }) {}

WorkThread::~WorkThread() {
    if (isForked()) {
        // Only a copy of the thread's handle is here, and the mutex is as fork() met it.
        thread_.detach();
        static_cast<void>(state_.release());
        return;
    }
    stopAll();
    {
        const std::lock_guard lock(state_->mutex);
        state_->ends = true;
    }
    state_->changed.notify_all();
    thread_.join();
}

bool WorkThread::isForked() const {
    return ::getpid() != process_;
}

void WorkThread::loop(State& state) {
    std::unique_lock lock(state.mutex);
    for (;;) {
        state.changed.wait(lock, [&] { return state.ends || (state.work && !state.isDone); });
        if (!state.work || state.isDone) return;
        lock.unlock();
        std::exception_ptr failure;
        try {
            (*state.work)([&] { return !state.stops && !stopsAll_; });
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        state.failure = failure;
        state.isDone = true;
        state.changed.notify_all();
    }
}

void WorkThread::run(const Work& work, const ShouldContinue& keepWaiting) {
    if (isForked()) {
        throw DeviceError(
            "This renderer belongs to the process that opened it, and this one was forked off; "
            "open another one here.",
            kExitFailed);
    }
    std::unique_lock user(users_, std::defer_lock);
    while (!user.try_lock_for(kPollInterval)) {
        if (!keepWaiting()) throw Stopped();
    }
    State& state = *state_;
    std::unique_lock lock(state.mutex);
    state.stops = false;
    state.isDone = false;
    state.work = &work;
    state.changed.notify_all();
    while (!state.changed.wait_for(lock, kPollInterval, [&] { return state.isDone; })) {
        lock.unlock();
        if (!state.stops && !keepWaiting()) state.stops = true;
        lock.lock();
    }
    state.work = nullptr;
    if (const std::exception_ptr failure = std::exchange(state.failure, nullptr))
        std::rethrow_exception(failure);
}

}  // namespace kaustik::python
