// SPDX-License-Identifier: MIT
#include "framework/core/number_text.h"

#include <fmt/format.h>

#include <cmath>

namespace kaustik {

std::string numberText(double number) {
    constexpr double kMaxWhole = 1e15;  // up to there each whole number is a double
    if (std::abs(number) < kMaxWhole && number == std::round(number))
        return fmt::format("{:.0f}", number);
    return fmt::format("{}", static_cast<float>(number));
}

}  // namespace kaustik
