// SPDX-License-Identifier: MIT
// The machine that something is timed on: its processor, and how busy other work keeps it
// meanwhile.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace kaustik {

// The model; "unknown" where the system does not tell.
[[nodiscard]] std::string processorName();

// Seconds of processor time since the machine and this process have begun.
struct ProcessorTimes {
    double machineSeconds = 0.0;  // of all processors; also what a hypervisor gave to others
    double ownSeconds = 0.0;
    std::chrono::steady_clock::time_point when;
};

// None where the system does not tell: it is Linux's /proc/stat, in hundredths of a second.
[[nodiscard]] std::optional<ProcessorTimes> processorTimes();

// How many processors other processes kept busy between the two, on average; none without both, or
// where they are nearer than a tenth of a second, which the clock is too coarse for.
[[nodiscard]] std::optional<double> otherProcessors(const std::optional<ProcessorTimes>& begin,
                                                    const std::optional<ProcessorTimes>& end);

}  // namespace kaustik
