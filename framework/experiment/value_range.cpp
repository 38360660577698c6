// SPDX-License-Identifier: MIT
#include "framework/experiment/value_range.h"

#include <fmt/format.h>

#include <cmath>

#include "framework/scene/files/table_reader.h"

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
    if (count > kMostValues) {
        reader.fail("factor", fmt::format("the range has more than {} values", kMostValues));
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
    if (count > kMostValues) {
        reader.fail("step", fmt::format("the range has more than {} values", kMostValues));
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
    const double from = reader.number("from", scene::kAnyNumber);
    const double to = reader.number("to", scene::kAnyNumber);
    const bool multiplies = reader.has("factor");
    const bool adds = reader.has("step");
    const bool divides = reader.has("steps");
    reader.finish();
    if (int(multiplies) + int(adds) + int(divides) != 1) {
        reader.fail("from", "a range takes one of factor, step and steps beside from and to");
    }
    std::vector<double> values;
    if (multiplies) {
        values = multiplied(reader, from, to, reader.number("factor", scene::kPositive));
    } else if (adds) {
        values = added(reader, from, to, reader.number("step", scene::kAnyNumber));
    } else {
        values = divided(from, to, reader.count("steps", 2, kMostValues));
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
