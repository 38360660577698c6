// SPDX-License-Identifier: MIT
#include "framework/gui/typed_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <variant>

#include "framework/core/error.h"

namespace kaustik::gui {
namespace {

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<double> numberOf(const std::string& text) {
    double number = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(number))
        return std::nullopt;
    return number;
}

std::string nearestSentence(const params::NamedField& named, const std::string& typed,
                            const std::string& taken) {
    return fmt::format("{} takes {}{}{}: of {} it has taken {}.", named.fullName,
                       named.field.rangeText(), named.field.unit.empty() ? "" : " ",
                       named.field.unit, typed, taken);
}

}  // namespace

double nearestValue(const params::Field& field, double number) {
    if (field.values.empty()) return std::clamp(number, field.minimum, field.maximum);
    const auto distance = [&](int value) { return std::abs(value - number); };
    return *std::min_element(field.values.begin(), field.values.end(),
                             [&](int a, int b) { return distance(a) < distance(b); });
}

TypedValue typedValue(const params::NamedField& named, const std::string& text) {
    // A place of its own, so that the settings stay as they are.
    int integer = 0;
    float real = 0.0f;
    params::Field probe = named.field;
    const bool isInteger = std::holds_alternative<int*>(probe.target);
    if (isInteger) {
        probe.target = &integer;
    } else {
        probe.target = &real;
    }
    const std::string typed = trimmed(text);
    try {
        probe.set(typed, named.fullName, "Typed");
        return {typed, ""};
    } catch (const ConfigError& error) {
        const std::optional<double> number = numberOf(typed);
        const bool isOutside =
            number && (*number < named.field.minimum || *number > named.field.maximum);
        const bool hasNearest = isOutside || (number && !named.field.values.empty());
        if (!hasNearest || (isInteger && *number != std::floor(*number))) return {"", error.what()};
        const double nearest = nearestValue(named.field, *number);
        const std::string taken = isInteger ? fmt::format("{}", static_cast<int>(nearest))
                                            : fmt::format("{}", static_cast<float>(nearest));
        return {taken, nearestSentence(named, typed, taken)};
    }
}

TypedValue typedExtent(const params::NamedField& named, params::Extent entered) {
    const auto within = [&](int side) {
        return std::clamp(side, static_cast<int>(named.field.minimum),
                          static_cast<int>(named.field.maximum));
    };
    const params::Extent nearest{within(entered.width), within(entered.height)};
    const std::string taken = fmt::format("{}x{}", nearest.width, nearest.height);
    if (nearest == entered) return {taken, ""};
    return {taken,
            nearestSentence(named, fmt::format("{}x{}", entered.width, entered.height), taken)};
}

}  // namespace kaustik::gui
