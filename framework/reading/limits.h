// SPDX-License-Identifier: MIT
// How much the reading of one file may take. A file that wants more is an error that says so, and
// how to allow it.
#pragma once

#include <cstdint>
#include <string>

namespace kaustik::reading {

// Names of the environment variables that replace the defaults.
inline constexpr const char* kSecondsVariable = "KAUSTIK_READ_SECONDS";
inline constexpr const char* kMemoryVariable = "KAUSTIK_READ_MEBIBYTES";

struct ReadLimits {
    // Seconds of processor time, so that a busy machine makes no file an error. The dragon of 871 k
    // triangles takes 2 s.
    std::uint64_t seconds = 60;
    // Mebibytes of address space, libraries included. The largest image that is allowed takes 2
    // GiB.
    std::uint64_t mebibytes = 4096;

    // What passes by the clock until a reader that does not even compute is given up: one that
    // waits for a device, say.
    [[nodiscard]] std::uint64_t clockSeconds() const { return 5 * seconds; }
    // "Set KAUSTIK_READ_SECONDS to more than 60 if …", to end a message with.
    [[nodiscard]] std::string timeAdvice() const;
    [[nodiscard]] std::string memoryAdvice() const;
};

// The defaults, or what the environment says. Throws ConfigError for what is no whole number above
// 0 there.
[[nodiscard]] ReadLimits readLimits();

}  // namespace kaustik::reading
