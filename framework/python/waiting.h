// SPDX-License-Identifier: MIT
// Long work for Python: other Python threads run meanwhile, and Ctrl-C ends it.
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <atomic>
#include <exception>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>

#include "framework/python/work_thread.h"

namespace kaustik::python {

// All calls of waitFor in the process.
struct Waits {
    std::atomic<int> count{0};
    std::atomic<bool> isEndRequested{false};  // the process is about to, on the thread `ending`
    std::thread::id ending;
    [[nodiscard]] bool exitWithoutThread() const {
        return isEndRequested && std::this_thread::get_id() != ending;
    }
};
inline Waits& waits() {
    static Waits all;
    return all;
}

// Never comes back, since Python will not be there: a thread that printed what was raised while it
// is taken down would bring the process down with it.
[[noreturn]] inline void rest() {
    for (;;)
        ::pause();
}

// Calls `work(keepWaiting)` without the GIL. Signals that arrive are handled on Python's main
// thread; what a handler raises, KeyboardInterrupt, comes out of here once the work has stopped, in
// place of whatever that has thrown.
template <class Work>
auto waitFor(Work&& work) {
    std::optional<pybind11::error_already_set> raised;
    struct Counted {
        Counted() { ++waits().count; }
        ~Counted() { --waits().count; }
    };
    std::optional<Counted> counted(std::in_place);
    const WorkThread::ShouldContinue keepWaiting = [&raised] {
        if (waits().isEndRequested) return false;
        const pybind11::gil_scoped_acquire gil;
        if (!raised && PyErr_CheckSignals() != 0) raised.emplace();
        return !raised;
    };
    using Result = std::invoke_result_t<Work, const WorkThread::ShouldContinue&>;
    std::conditional_t<std::is_void_v<Result>, bool, std::optional<Result>> result{};
    std::exception_ptr failure;
    {
        const pybind11::gil_scoped_release noGil;
        try {
            if constexpr (std::is_void_v<Result>) {
                work(keepWaiting);
            } else {
                result = work(keepWaiting);
            }
        } catch (...) {
            failure = std::current_exception();
        }
        counted.reset();
        if (waits().exitWithoutThread()) rest();
    }
    if (raised) throw pybind11::error_already_set(*raised);
    if (failure) std::rethrow_exception(failure);
    if constexpr (!std::is_void_v<Result>) return std::move(*result);
}

}  // namespace kaustik::python
