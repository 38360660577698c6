// SPDX-License-Identifier: MIT
#include "framework/scene/files/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/core/error.h"
#include "framework/core/names.h"

namespace kaustik::scene {
namespace {

// What a wrong value looks like in a message: short, whatever it is.
std::string shown(const TomlNode& node) {
    if (const auto* text = node.as<std::string>()) return fmt::format("'{}'", text->substr(0, 40));
    if (const auto* integer = node.as<std::int64_t>()) return fmt::format("{}", *integer);
    if (const auto* number = node.as<double>()) return fmt::format("{}", *number);
    if (const auto* flag = node.as<bool>()) return *flag ? "true" : "false";
    if (const auto* list = node.list()) return fmt::format("a list of {}", list->size());
    return node.as<TomlTable>() ? "a table" : "a date or time";
}

std::string sentence(const std::string& text) {
    return text.ends_with('?') || text.ends_with('.') ? text : text + ".";
}

double validNumber(const NumberRange& range) {
    return 0.5 * (std::max(range.minimum, -2.0) + std::min(range.maximum, 4.0));
}

}  // namespace

bool NumberRange::contains(double value) const {
    return (withoutMinimum ? value > minimum : value >= minimum) &&
           (withoutMaximum ? value < maximum : value <= maximum);
}

std::string NumberRange::description() const {
    return fmt::format("{} {:g} and {} {:g}", withoutMinimum ? "greater than" : "at least", minimum,
                       withoutMaximum ? "less than" : "at most", maximum);
}

TableReader::TableReader(const TomlNode& table, std::filesystem::path file, std::string subject)
    : table_(&table), file_(std::move(file)), subject_(std::move(subject)) {}

const TomlNode* TableReader::find(std::string_view key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
    return table_->find(key);
}

const TomlNode* TableReader::require(std::string_view key, bool optional) {
    const TomlNode* node = find(key);
    if (node == nullptr && !optional) missing_.emplace_back(key);
    return node;
}

double TableReader::checkedNumber(std::string_view key, const TomlNode& node,
                                  const NumberRange& range) const {
    if (!node.isNumber()) fail(key, fmt::format("{} must be a number, not {}", key, shown(node)));
    const auto* const integer = node.as<std::int64_t>();
    const double value = integer != nullptr ? static_cast<double>(*integer) : *node.as<double>();
    if (!std::isfinite(value) || !range.contains(value)) {
        fail(key, fmt::format("{} must be {}, not {}", key, range.description(), shown(node)));
    }
    return value;
}

std::vector<double> TableReader::numbers(std::string_view key, const TomlNode& node,
                                         std::size_t size, bool uniform,
                                         const NumberRange& range) const {
    if (uniform && node.isNumber()) return std::vector(size, checkedNumber(key, node, range));
    const std::vector<TomlNode>* array = node.list();
    if (array == nullptr || array->size() != size) {
        fail(key, fmt::format("{} must be {}a list of {} numbers, not {}", key,
                              uniform ? "a number or " : "", size, shown(node)));
    }
    std::vector<double> values;
    for (const TomlNode& element : *array)
        values.push_back(checkedNumber(key, element, range));
    return values;
}

unsigned TableReader::checkedCount(std::string_view key, const TomlNode& node, unsigned minimum,
                                   unsigned maximum) const {
    const auto* const integer = node.as<std::int64_t>();
    if (integer == nullptr || *integer < minimum || *integer > maximum) {
        fail(key, fmt::format("{} must be a whole number from {} to {}, not {}", key, minimum,
                              maximum, shown(node)));
    }
    return static_cast<unsigned>(*integer);
}

double TableReader::number(std::string_view key, const NumberRange& range,
                           std::optional<double> fallback) {
    const TomlNode* node = require(key, fallback.has_value());
    return node ? checkedNumber(key, *node, range) : fallback.value_or(validNumber(range));
}

float TableReader::numberAsFloat(std::string_view key, const NumberRange& range,
                                 std::optional<double> fallback) {
    return static_cast<float>(number(key, range, fallback));
}

unsigned TableReader::count(std::string_view key, unsigned minimum, unsigned maximum,
                            std::optional<unsigned> fallback) {
    const TomlNode* node = require(key, fallback.has_value());
    return node ? checkedCount(key, *node, minimum, maximum) : fallback.value_or(minimum);
}

glm::uvec2 TableReader::counts(std::string_view key, unsigned minimum, unsigned maximum,
                               std::optional<glm::uvec2> fallback) {
    const TomlNode* node = require(key, fallback.has_value());
    if (node == nullptr) return fallback.value_or(glm::uvec2(minimum));
    const std::vector<TomlNode>* array = node->list();
    if (array == nullptr) return glm::uvec2(checkedCount(key, *node, minimum, maximum));
    if (array->size() != 2) {
        fail(key, fmt::format("{} must be one or two whole numbers, not {}", key, shown(*node)));
    }
    return {checkedCount(key, array->front(), minimum, maximum),
            checkedCount(key, array->back(), minimum, maximum)};
}

glm::dvec2 TableReader::vector2(std::string_view key, const NumberRange& range,
                                std::optional<glm::dvec2> fallback) {
    const TomlNode* node = require(key, fallback.has_value());
    if (node == nullptr) return fallback.value_or(glm::dvec2(validNumber(range)));
    const std::vector<double> v = numbers(key, *node, 2, false, range);
    return {v[0], v[1]};
}

glm::dvec3 TableReader::vector3(std::string_view key, const NumberRange& range,
                                std::optional<glm::dvec3> fallback) {
    const TomlNode* node = require(key, fallback.has_value());
    if (node == nullptr) return fallback.value_or(glm::dvec3(validNumber(range)));
    const std::vector<double> v = numbers(key, *node, 3, false, range);
    return {v[0], v[1], v[2]};
}

glm::dvec2 TableReader::uniformOrVector2(std::string_view key, const NumberRange& range,
                                         std::optional<glm::dvec2> fallback) {
    const TomlNode* node = require(key, fallback.has_value());
    if (node == nullptr) return fallback.value_or(glm::dvec2(validNumber(range)));
    const std::vector<double> v = numbers(key, *node, 2, true, range);
    return {v[0], v[1]};
}

glm::dvec3 TableReader::uniformOrVector3(std::string_view key, const NumberRange& range,
                                         std::optional<glm::dvec3> fallback) {
    const TomlNode* node = require(key, fallback.has_value());
    if (node == nullptr) return fallback.value_or(glm::dvec3(validNumber(range)));
    const std::vector<double> v = numbers(key, *node, 3, true, range);
    return {v[0], v[1], v[2]};
}

glm::dvec3 unitDirection(const glm::dvec3& vector) {
    return glm::normalize(vector /
                          std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)}));
}

glm::dvec3 TableReader::direction(std::string_view key) {
    const glm::dvec3 vector = vector3(key, kAnyNumber);
    if (vector == glm::dvec3(0.0)) fail(key, fmt::format("{} must not be the zero vector", key));
    return unitDirection(vector);
}

bool TableReader::flag(std::string_view key, bool fallback) {
    const TomlNode* node = find(key);
    if (node == nullptr) return fallback;
    const bool* const value = node->as<bool>();
    if (value == nullptr) {
        fail(key, fmt::format("{} must be true or false, not {}", key, shown(*node)));
    }
    return *value;
}

std::string TableReader::text(std::string_view key, std::optional<std::string> fallback) {
    const TomlNode* node = require(key, fallback.has_value());
    if (node == nullptr) return fallback.value_or("");
    const auto* const value = node->as<std::string>();
    if (value == nullptr) fail(key, fmt::format("{} must be text, not {}", key, shown(*node)));
    return *value;
}

std::vector<std::string> TableReader::texts(std::string_view key) {
    const TomlNode* node = find(key);
    if (node == nullptr) return {};
    const std::vector<TomlNode>* array = node->list();
    if (array == nullptr) {
        fail(key, fmt::format("{} must be a list of texts, not {}", key, shown(*node)));
    }
    std::vector<std::string> values;
    for (const TomlNode& element : *array) {
        const auto* const value = element.as<std::string>();
        if (value == nullptr) {
            fail(key, fmt::format("{} must hold texts only, not {}", key, shown(element)));
        }
        values.push_back(*value);
    }
    return values;
}

std::string TableReader::name() {
    const std::string value = text("name");
    if (has("name") && value.empty()) fail("name", "name must not be empty");
    if (!value.empty()) subject_ = fmt::format("{} '{}'", subject_, value);
    return value;
}

std::optional<TableReader> TableReader::table(std::string_view key) {
    const TomlNode* node = find(key);
    if (node == nullptr) return std::nullopt;
    if (node->as<TomlTable>() == nullptr) {
        fail(key, fmt::format("{0} must be one table, [{0}], not {1}", key, shown(*node)));
    }
    return TableReader(*node, file_,
                       subject_.empty() ? std::string(key) : fmt::format("{}: {}", subject_, key));
}

std::vector<TableReader> TableReader::tables(std::string_view key) {
    const TomlNode* node = find(key);
    if (node == nullptr) return {};
    const std::vector<TomlNode>* array = node->list();
    const bool right =
        array != nullptr && std::all_of(array->begin(), array->end(), [](const TomlNode& element) {
            return element.as<TomlTable>() != nullptr;
        });
    if (!right) {
        fail(key, fmt::format("{0} must be a list of tables, [[{0}]], not {1}", key, shown(*node)));
    }
    std::vector<TableReader> readers;
    for (const TomlNode& element : *array) {
        readers.emplace_back(
            element, file_,
            subject_.empty() ? std::string(key) : fmt::format("{}: {}", subject_, key));
    }
    return readers;
}

bool TableReader::has(std::string_view key) {
    return find(key) != nullptr;
}

void TableReader::finish() const {
    for (const auto& [name, node] : table_->entries()) {
        if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
        const std::string suggestion = didYouMean(name, known_);
        fail(name,
             fmt::format("'{}' is not a key{}", name,
                         suggestion.empty() ? "; the keys are " + joinNames(known_) : suggestion));
    }
    if (!missing_.empty()) failMissing(missing_.front());
}

void TableReader::failMissing(std::string_view key) const {
    for (const auto& [other, node] : table_->entries()) {
        const bool unknown = std::find(known_.begin(), known_.end(), other) == known_.end();
        if (unknown && !nearestName(other, {std::string(key)}).empty()) {
            fail(other, fmt::format("'{}' is not a key; did you mean '{}'?", other, key));
        }
    }
    fail(key, fmt::format("'{}' is missing", key));
}

std::string TableReader::place(std::string_view key) const {
    if (!file_.has_filename()) return "the scene";
    const TomlNode* node = key.empty() ? nullptr : table_->find(key);
    return fmt::format("{}:{}", file_.string(), std::max(1u, (node ? node : table_)->line));
}

void TableReader::fail(std::string_view key, const std::string& message) const {
    throw ConfigError(sentence(
        fmt::format("{}: {}{}{}", place(key), subject_, subject_.empty() ? "" : ": ", message)));
}

std::string TableReader::notOneOf(std::string_view value, const std::vector<std::string>& names) {
    return fmt::format("'{}' is not one of {}{}", value, joinNames(names),
                       didYouMean(value, names));
}

}  // namespace kaustik::scene
