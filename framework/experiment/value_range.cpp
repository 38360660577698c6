// SPDX-License-Identifier: MIT
#include "framework/experiment/value_range.h"

#include <fmt/format.h>

#include <cmath>

#include "framework/experiment/spec_keys.h"

namespace kaustik::experiment {
namespace {

using nlohmann::json;
using scene::TableReader;

// How near the last value must come to `to` in order to be it: rounding, not intent.
constexpr double kRelativeSlack = 1e-9;

double rounded(double value) {
    return std::stod(fmt::format("{:.12g}", value));
}

std::vector<double> multiplied(TableReader& reader, double from, double to, double factor) {
    if (from <= 0.0 || to <= 0.0) {
        reader.fail("factor", "a range with a factor must be from and to more than 0");
    }
    if (factor == 1.0 || (factor > 1.0) != (from <= to)) {
        reader.fail("factor",
                    fmt::format("the range has no values: multiplying {:g} by {:g} does not lead "
                                "to {:g}",
                                from, factor, to));
    }
    const double count = std::floor(std::log(to / from) / std::log(factor) + kRelativeSlack) + 1.0;
    if (count > kMaxValues) {
        reader.fail("factor", fmt::format("the range has more than {} values", kMaxValues));
    }
    std::vector<double> values;
    for (int i = 0; i < static_cast<int>(count); ++i)
        values.push_back(from * std::pow(factor, i));
    return values;
}

std::vector<double> added(TableReader& reader, double from, double to, double step) {
    if (step == 0.0 || (step > 0.0) != (from <= to)) {
        reader.fail("step", fmt::format("the range has no values: adding {:g} to {:g} does not "
                                        "lead to {:g}",
                                        step, from, to));
    }
    const double count = std::floor((to - from) / step + kRelativeSlack) + 1.0;
    if (count > kMaxValues) {
        reader.fail("step", fmt::format("the range has more than {} values", kMaxValues));
    }
    std::vector<double> values;
    for (int i = 0; i < static_cast<int>(count); ++i)
        values.push_back(from + step * i);
    return values;
}

std::vector<double> divided(double from, double to, unsigned count) {
    std::vector<double> values;
    for (unsigned i = 0; i < count; ++i)
        values.push_back(from + (to - from) * i / (count - 1));
    return values;
}

}  // namespace

std::vector<json> readRange(const scene::TomlNode& table, const std::string& key,
                            const std::filesystem::path& file) {
    TableReader reader(table, file, fmt::format("permute: {}", key));
    const auto range = reader.read<RangeKeys>();
    std::vector<double> values;
    if (range.factor) {
        values = multiplied(reader, range.from, range.to, *range.factor);
    } else if (range.step) {
        values = added(reader, range.from, range.to, *range.step);
    } else {
        values = divided(range.from, range.to, *range.steps);
    }

    bool isWhole = true;
    for (const auto& [name, node] : table.entries())
        isWhole = isWhole && node.as<std::int64_t>() != nullptr;
    for (double& value : values) {
        value = rounded(value);
        isWhole = isWhole && value == std::round(value);
    }
    std::vector<json> result;
    for (const double value : values) {
        if (isWhole) {
            result.emplace_back(static_cast<std::int64_t>(value));
        } else {
            result.emplace_back(value);
        }
    }
    return result;
}

}  // namespace kaustik::experiment
