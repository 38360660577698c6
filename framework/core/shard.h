// SPDX-License-Identifier: MIT
// One of several equal parts of work that are done apart: "2/8" is the second of eight.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace kaustik {

struct Shard {
    std::uint64_t number = 1;  // from 1
    std::uint64_t count = 1;
    bool operator==(const Shard&) const = default;
};

inline constexpr std::uint64_t kMaxShards = 1'000'000;

// "K/N" with K from 1 to N; throws ConfigError that names `option` for anything else, and calls the
// parts `part`.
[[nodiscard]] Shard parseShard(const std::string& text, const std::string& option,
                               const std::string& part = "shard");

// [first, end) of `items` that are numbered from 0. The shards of a count hold every item once, and
// as many as each other but for one; where there are fewer items than shards, some have none.
[[nodiscard]] std::pair<std::uint64_t, std::uint64_t> rangeOf(const Shard& shard,
                                                              std::uint64_t items);

// "2, 4 to 7 and 9" of ascending numbers.
[[nodiscard]] std::string listOfNumbers(const std::vector<std::uint64_t>& numbers);

}  // namespace kaustik
