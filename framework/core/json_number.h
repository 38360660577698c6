// SPDX-License-Identifier: MIT
// Whole numbers from JSON that somebody else may have written.
#pragma once

#include <concepts>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

namespace kaustik {

// `value` as a T. Throws nlohmann::json::type_error, as the library's own conversions do, for what
// is no whole number or does not fit into T: those convert it nevertheless, to a value that the
// language leaves open.
template <std::integral T>
[[nodiscard]] T wholeNumber(const nlohmann::json& value) {
    if (value.is_number_unsigned()) {
        if (const auto number = value.get<std::uint64_t>(); std::in_range<T>(number))
            return static_cast<T>(number);
    } else if (value.is_number_integer()) {
        if (const auto number = value.get<std::int64_t>(); std::in_range<T>(number))
            return static_cast<T>(number);
    }
    const std::string found = value.is_number() ? value.dump() : value.type_name();
    throw nlohmann::json::type_error::create(
        302, "there must be a whole number that fits its place, not " + found, &value);
}

}  // namespace kaustik
