// SPDX-License-Identifier: MIT
// Times by the clock that never goes back.
#pragma once

#include <chrono>

namespace kaustik {

[[nodiscard]] inline double millisecondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
        .count();
}

}  // namespace kaustik
