// SPDX-License-Identifier: MIT
// Suggestions for mistyped names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kaustik {

// The candidate with the smallest edit distance to `name` (insert, delete, replace, swap of
// neighbours), or "" when there is none near enough to be meant.
[[nodiscard]] std::string nearestName(std::string_view name,
                                      const std::vector<std::string>& candidates);

// "; did you mean 'x'?" or "", to end an error message with.
[[nodiscard]] std::string didYouMean(std::string_view name,
                                     const std::vector<std::string>& candidates);

// "a, b and c"; "" for none.
[[nodiscard]] std::string joinNames(const std::vector<std::string>& names);

// `text` as a string of a TOML file, quotes included.
[[nodiscard]] std::string tomlString(std::string_view text);

}  // namespace kaustik
