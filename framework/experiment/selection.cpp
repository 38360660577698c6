// SPDX-License-Identifier: MIT
#include "framework/experiment/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "framework/core/error.h"
#include "framework/core/names.h"

namespace kaustik::experiment {
namespace {

using nlohmann::json;

std::string textOf(const json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

bool isValue(const json& value, const std::string& text) {
    if (textOf(value) == text) return true;
    if (!value.is_number() || text.empty()) return false;
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    return *end == '\0' && number == value.get<double>();
}

// The axis of that name, or the only one that ends in ".name"; "" where there is none.
std::string axisOf(const Plan& plan, const std::string& name) {
    std::vector<std::string> ends;
    for (const AxisDescription& axis : plan.axes) {
        if (axis.key == name) return name;
        if (("." + axis.key).ends_with("." + name)) ends.push_back(axis.key);
    }
    return ends.size() == 1 ? ends.front() : "";
}

[[noreturn]] void failAxis(const Plan& plan, const std::string& option, const std::string& name) {
    std::vector<std::string> keys;
    for (const AxisDescription& axis : plan.axes)
        keys.push_back(axis.key);
    if (keys.empty()) {
        throw ConfigError(fmt::format("{}: {} has one run and varies nothing to choose by.", option,
                                      plan.spec.file.string()));
    }
    const std::string suggestion = didYouMean(name, keys);
    throw ConfigError(fmt::format("{}: {} does not vary '{}'{} It varies {}.", option,
                                  plan.spec.file.string(), name,
                                  suggestion.empty() ? "." : suggestion, joinNames(keys)));
}

void requireValue(const Plan& plan, const std::string& option, const std::string& axis,
                  const std::string& text) {
    std::vector<std::string> values;
    for (const PlannedRun& run : plan.runs) {
        const json& value = run.axes.at(axis);
        if (isValue(value, text)) return;
        const std::string other = textOf(value);
        if (std::find(values.begin(), values.end(), other) == values.end()) values.push_back(other);
    }
    const std::string suggestion = didYouMean(text, values);
    throw ConfigError(fmt::format("{}: no run of {} has {} = '{}'{} There is {}.", option,
                                  plan.spec.file.string(), axis, text,
                                  suggestion.empty() ? "." : suggestion, joinNames(values)));
}

}  // namespace

std::set<std::string> selectRuns(const Plan& plan, const std::vector<std::string>& conditions,
                                 const std::string& option) {
    std::map<std::string, std::vector<std::string>> wanted;  // values by axis
    for (const std::string& condition : conditions) {
        const std::size_t equals = condition.find('=');
        if (equals == std::string::npos || equals == 0) {
            throw ConfigError(
                fmt::format("{}: '{}' is not KEY=VALUE, such as scene=pool.", option, condition));
        }
        const std::string name = condition.substr(0, equals);
        const std::string value = condition.substr(equals + 1);
        const std::string axis = axisOf(plan, name);
        if (axis.empty()) failAxis(plan, option, name);
        requireValue(plan, option, axis, value);
        wanted[axis].push_back(value);
    }
    std::set<std::string> hashes;
    for (const PlannedRun& run : plan.runs) {
        const bool isWanted = std::all_of(wanted.begin(), wanted.end(), [&](const auto& condition) {
            return std::any_of(condition.second.begin(), condition.second.end(),
                               [&](const std::string& value) {
                                   return isValue(run.axes.at(condition.first), value);
                               });
        });
        if (isWanted) hashes.insert(run.hash);
    }
    if (hashes.empty()) {
        throw ConfigError(fmt::format("{}: no run of {} has all of these values together.", option,
                                      plan.spec.file.string()));
    }
    return hashes;
}

}  // namespace kaustik::experiment
