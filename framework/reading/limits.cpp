// SPDX-License-Identifier: MIT
#include "framework/reading/limits.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "framework/core/error.h"

namespace kaustik::reading {
namespace {

constexpr std::uint64_t kMaxLimit = 1u << 30;  // in seconds a lifetime, in mebibytes a pebibyte

void replace(std::uint64_t& value, const char* variable) {
    const char* const found = std::getenv(variable);
    if (found == nullptr || *found == '\0') return;
    const std::string_view text(found);
    std::uint64_t number = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || end != text.data() + text.size() || number < 1 ||
        number > kMaxLimit) {
        throw ConfigError(
            fmt::format("{}: '{}' is not a whole number from 1 to {}.", variable, text, kMaxLimit));
    }
    value = number;
}

}  // namespace

std::string ReadLimits::timeAdvice() const {
    return fmt::format("If it is to be trusted, set {} to more than {}.", kSecondsVariable,
                       seconds);
}

std::string ReadLimits::memoryAdvice() const {
    return fmt::format("If it is to be trusted, set {} to more than {}.", kMemoryVariable,
                       mebibytes);
}

ReadLimits readLimits() {
    ReadLimits limits;
    replace(limits.seconds, kSecondsVariable);
    replace(limits.mebibytes, kMemoryVariable);
    return limits;
}

}  // namespace kaustik::reading
