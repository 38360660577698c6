// SPDX-License-Identifier: MIT
// Runs a function with a number of oneTBB threads, more than the machine has cores if asked
// (tests).
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace kaustik::reference {

// 0: all cores.
[[nodiscard]] inline int threadCount(int threads) {
    return threads > 0 ? threads : std::max(tbb::this_task_arena::max_concurrency(), 1);
}

template <class Function>
void runWithThreads(int threads, const Function& function) {
    const int count = threadCount(threads);
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(count));
    tbb::task_arena arena(count);
    arena.execute(function);
}

}  // namespace kaustik::reference
