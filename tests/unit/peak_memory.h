// SPDX-License-Identifier: MIT
// How much memory something took at most.
#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace kaustik::test {

// The most memory that this process has had so far, in bytes. What is below a peak that was reached
// before cannot be seen; each test has a process of its own under ctest.
inline std::size_t peakBytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace kaustik::test
