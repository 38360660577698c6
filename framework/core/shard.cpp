// SPDX-License-Identifier: MIT
#include "framework/core/shard.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "framework/core/error.h"

namespace kaustik {

Shard parseShard(const std::string& text, const std::string& option, const std::string& part) {
    Shard shard{0, 0};
    const char* const end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, shard.number);
    bool isRead = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
    if (isRead) {
        const auto count = std::from_chars(number.ptr + 1, end, shard.count);
        isRead = count.ec == std::errc() && count.ptr == end;
    }
    if (!isRead) {
        throw ConfigError(fmt::format(
            "{}: '{}' is not K/N, such as 2/8 for the second of eight {}s.", option, text, part));
    }
    if (shard.count < 1 || shard.count > kMaxShards) {
        throw ConfigError(fmt::format("{}: {} is not a number of {}s from 1 to {}.", option,
                                      shard.count, part, kMaxShards));
    }
    if (shard.number < 1 || shard.number > shard.count) {
        throw ConfigError(fmt::format("{}: there is no {} {} of {}; they count from 1 to {}.",
                                      option, part, shard.number, shard.count, shard.count));
    }
    return shard;
}

std::pair<std::uint64_t, std::uint64_t> rangeOf(const Shard& shard, std::uint64_t items) {
    // The first `longer` shards hold one more; no product that could overflow.
    const std::uint64_t each = items / shard.count;
    const std::uint64_t longer = items % shard.count;
    const auto begin = [&](std::uint64_t before) {
        return before * each + std::min(before, longer);
    };
    return {begin(shard.number - 1), begin(shard.number)};
}

std::string listOfNumbers(const std::vector<std::uint64_t>& numbers) {
    std::vector<std::string> parts;
    for (std::size_t first = 0; first < numbers.size();) {
        std::size_t last = first;
        while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1)
            ++last;
        if (last < first + 2) last = first;  // "4 and 5" rather than "4 to 5"
        parts.push_back(last == first ? fmt::format("{}", numbers[first])
                                      : fmt::format("{} to {}", numbers[first], numbers[last]));
        first = last + 1;
    }
    std::string text;
    for (std::size_t i = 0; i < parts.size(); ++i)
        text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
    return text;
}

}  // namespace kaustik
